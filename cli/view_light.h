// The light that relights a mesh or is drawn: options that `relight` and `render` share.
#pragma once

#include <memory>
#include <string>

#include "shbake.h"

namespace CLI {
class App;
}

namespace shbake::cli {

struct Session;

/// A light, ready for use in the axes of the mesh: distant, or a rig of local ones.
struct ViewLight {
  Light light;                          ///< at the order asked for, windowed; black where there is a rig
  std::shared_ptr<const LightRig> rig;  ///< the same of local lights, or null
  RadianceFunction source;              ///< what `light` was made from, where that is known and was asked for; or empty
  std::string description;              ///< for reports and file headers: "clear sky, sun at 40, 120"

  int order() const { return rig ? rig->samples()[0].light.order : light.order; }
  /// The light that arrives at a place.
  Light at(const Vec3d& place) const { return rig ? rig->at(place) : light; }
  /// What one sees who looks around at a place: the source, or what the bands of the light give.
  RadianceFunction seenFrom(const Vec3d& place) const;
  /// Radiance of points with this transfer at these places.
  std::vector<Rgb> colors(const TransferSet& transfer, std::span<const Vec3d> places, const RelightOptions& options,
                          const Parallel& parallel) const;
  /// All of it turned; a rig as a whole, about a place.
  ViewLight turned(const sh::Matrix3d& rotation, const Vec3d& about) const;
};

/// What the options say.
class ViewLightOptions {
 public:
  void declare(CLI::App& app);

  /// Reads or computes the light; ViewLight::source on demand. What reading had to assume is warned of. A light file of
  /// a lower order keeps its own.
  ViewLight make(int order, bool withSource, Session& session) const;

  std::string name = "overcast";  ///< a sky, "white", a light file or an image
  UpAxis up = UpAxis::z;          ///< of the mesh

 private:
  ViewLight makeSky(int order) const;
  ViewLight readFile(int order) const;
  ViewLight readImage(int order, bool withSource, Session& session) const;

  SkyOptions sky_;
  EnvironmentMapOptions map_;
  Vec3d sunIrradiance_;
  double turn_ = 0;  // degrees
  sh::Window window_ = sh::Window::none;
};

}  // namespace shbake::cli
