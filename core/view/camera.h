// A pinhole camera that is placed so that a mesh fills the picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "light/environment_map.h"

namespace shbake {

/// Where the camera stands, seen from the mesh: as SkyOptions has the sun.
struct View {
  double azimuth = 205;   ///< degrees clockwise from north (+y), seen from above: 90 = east = +x
  double elevation = 25;  ///< degrees above the horizon, -90..90
};

/// "front" (from -y), "back", "left" (from -x), "right", "top", "bottom" (north up), "corner" (the default View).
std::optional<View> viewNamed(const std::string& name);
std::vector<std::string> viewNames();

struct Camera {
  Vec3d eye;
  Vec3d right, up, forward;               ///< orthonormal, right x up = -forward
  double tangentX = 0.5, tangentY = 0.5;  ///< of half the angle of view, sideways and upwards

  /// x and y are -1..1 within the picture, y upwards; depth along `forward`, in units of the mesh. What lies behind the
  /// camera has a depth of 0 or less and no place in the picture: x and y are 0.
  struct Projected {
    double x = 0, y = 0, depth = 0;
  };
  Projected project(const Vec3d& point) const;
  /// Unit vector from the eye through the place (x, y) of the picture.
  Vec3d direction(double x, double y) const;
};

struct CameraOptions {
  View view;
  UpAxis up = UpAxis::z;    ///< for UpAxis::y the same scene turned by axesFor(): north is -z
  double fieldOfView = 30;  ///< degrees, of the longer side of the picture: 1..150
  double aspect = 4.0 / 3;  ///< width : height of the picture
  double margin = 0.04;     ///< share of the picture left free on each side, 0..0.4
};

/// The camera nearest to the points that shows all of them within the margins: for each pair of opposite sides of the
/// pyramid of view the two planes that touch the points fix its place, and the farther of the two solutions holds both.
/// All depths are positive. Throws a usage error when there are no points, one is not finite, or options are out of
/// range.
Camera fitCamera(std::span<const Vec3d> points, const CameraOptions& options);

}  // namespace shbake
