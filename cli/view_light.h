// The light that relights a mesh or is drawn: options that `relight` and `render` share.
#pragma once

#include <string>

#include "shbake.h"

namespace CLI {
class App;
}

namespace shbake::cli {

struct Session;

/// A light, ready for use in the axes of the mesh.
struct ViewLight {
  Light light;                ///< at the order asked for; windowed
  RadianceFunction radiance;  ///< what the light was made from where that is known exactly, else the light itself
  bool exact = false;         ///< `radiance` is what it was made from
  std::string description;    ///< for reports and file headers: "clear sky, sun at 40, 120"
};

/// What the options say.
class ViewLightOptions {
 public:
  void declare(CLI::App& app);

  /// Reads or computes the light. What reading had to assume is warned of. A light file of a lower order keeps its own.
  ViewLight make(int order, Session& session) const;

  std::string name = "overcast";  ///< a sky, "white", a light file or an image
  UpAxis up = UpAxis::z;          ///< of the mesh

 private:
  ViewLight makeSky(int order) const;
  ViewLight readImage(int order, Session& session) const;

  SkyOptions sky_;
  Vec3d sunIrradiance_;
  double turn_ = 0;  // degrees
  sh::Window window_ = sh::Window::none;
};

/// True for the name of a light file.
bool isLightFile(const std::string& path);

}  // namespace shbake::cli
