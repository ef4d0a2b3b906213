// The light of the relighting filter and of the live view: what a person chooses, and the coefficients it has.
#pragma once

#include <string>
#include <vector>

#include "shbake.h"

namespace shbake::meshlab {

/// What light comes from.
enum class LightKind { overcast, clear, partlyCloudy, white, disc, file };
/// Their names in menus, in order.
const std::vector<std::string>& lightKindNames();

struct LightChoice {
  LightKind kind = LightKind::overcast;
  std::string file;           ///< an environment map or a .shlight file, for LightKind::file
  double sunAltitude = 45;    ///< degrees above the horizon, 0..90: of a sky's sun, or of the disc
  double sunAzimuth = 0;      ///< degrees clockwise from north (+y): the same
  double sunIrradiance = 0;   ///< of the sun's disc on a surface that faces it; skies only
  double discHalfAngle = 10;  ///< degrees 0..90: of the disc, which gives a facing surface irradiance pi
  double ground = 0;          ///< albedo of the ground below a sky, 0..1
  double turn = 0;            ///< degrees about the axis that points up, counter-clockwise seen from above
  UpAxis up = UpAxis::z;      ///< of the mesh
  sh::Window window = sh::Window::none;
};

/// Throws a usage error that names the first value out of its range.
void validate(const LightChoice& choice);

/// Makes light, and keeps the last file that it read: turning a light must not read its map again.
class LightMaker {
 public:
  /// The light in the axes of the mesh, of at most `order` bands. What reading a file had to assume is added to
  /// `notes`. Throws usage errors as validate() does, and what reading the file throws.
  Light make(const LightChoice& choice, int order, const Parallel& parallel, Progress& progress,
             std::vector<std::string>& notes);

 private:
  const Light& readFile(const std::string& path, int order, const Parallel& parallel, Progress& progress,
                        std::vector<std::string>& notes);

  std::string path_;
  long long time_ = 0;  // when the file was written last
  int order_ = 0;
  Light light_;  // in axes with z up
  std::vector<std::string> notes_;
};

}  // namespace shbake::meshlab
