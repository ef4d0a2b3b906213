// Placing a pinhole camera: a linear program with four constraints a point, solved in closed form.
#include "view/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"

namespace shbake {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

struct NamedView {
  const char* name;
  View view;
};

constexpr std::array<NamedView, 7> kViews{{{"front", {180, 0}},
                                           {"back", {0, 0}},
                                           {"left", {270, 0}},
                                           {"right", {90, 0}},
                                           {"top", {180, 90}},
                                           {"bottom", {180, -90}},
                                           {"corner", {}}}};

void requireRange(double value, double least, double most, const std::string& what) {
  if (value >= least && value <= most) return;
  throw usageError("the " + what + " is out of range", "give " + std::to_string(least) + " to " + std::to_string(most));
}

void validate(const CameraOptions& options) {
  requireRange(options.view.elevation, -90, 90, "elevation of the view");
  requireRange(options.view.azimuth, -1e6, 1e6, "azimuth of the view");
  requireRange(options.fieldOfView, 1, 150, "angle of view");
  requireRange(options.aspect, 1e-4, 1e4, "aspect of the picture");
  requireRange(options.margin, 0, 0.4, "margin of the picture");
}

Camera orient(const CameraOptions& options) {
  const double azimuth = options.view.azimuth * kRadians, elevation = options.view.elevation * kRadians;
  const Vec3d level{std::sin(azimuth), std::cos(azimuth), 0};
  // Derivatives of the direction towards the camera: defined at the poles too.
  const Vec3d back = level * std::cos(elevation) + Vec3d{0, 0, std::sin(elevation)};
  const Vec3d up = level * -std::sin(elevation) + Vec3d{0, 0, std::cos(elevation)};
  const sh::Matrix3d axes = axesFor(options.up);
  Camera camera;
  camera.forward = axes * -back;
  camera.up = axes * up;
  camera.right = cross(camera.forward, camera.up);
  const double half = std::tan(options.fieldOfView * kRadians / 2);
  camera.tangentX = options.aspect >= 1 ? half : half * options.aspect;
  camera.tangentY = options.aspect >= 1 ? half / options.aspect : half;
  return camera;
}

/// The planes of view that touch the points, of one pair of opposite sides: how far out the points reach along the axis
/// and against it, each less tangent * depth.
struct Support {
  double low = -std::numeric_limits<double>::infinity(), high = low;

  void add(double along, double depth, double tangent) {
    high = std::max(high, along - tangent * depth);
    low = std::max(low, -along - tangent * depth);
  }
  /// The greatest depth that the eye may have, and the place along the axis that centres the points there.
  double depth(double tangent) const { return -(low + high) / (2 * tangent); }
  double centre() const { return (high - low) / 2; }
};

}  // namespace

std::optional<View> viewNamed(const std::string& name) {
  for (const NamedView& v : kViews) {
    if (name == v.name) return v.view;
  }
  return std::nullopt;
}

std::vector<std::string> viewNames() {
  std::vector<std::string> names;
  for (const NamedView& v : kViews) names.emplace_back(v.name);
  return names;
}

Camera::Projected Camera::project(const Vec3d& point) const {
  const Vec3d d = point - eye;
  const double depth = dot(d, forward);
  if (!(depth > 0)) return {0, 0, depth};
  return {dot(d, right) / (depth * tangentX), dot(d, up) / (depth * tangentY), depth};
}

Vec3d Camera::direction(double x, double y) const {
  return normalized(forward + right * (x * tangentX) + up * (y * tangentY));
}

Camera fitCamera(std::span<const Vec3d> points, const CameraOptions& options) {
  validate(options);
  if (points.empty()) throw usageError("there is nothing to look at", "give a mesh with vertices");
  Camera camera = orient(options);
  const double inner = 1 - 2 * options.margin;
  const double tangentX = camera.tangentX * inner, tangentY = camera.tangentY * inner;
  // Relative to the first point, so that meshes far from the origin lose no digits.
  const Vec3d origin = points[0];
  Support x, y;
  double nearest = std::numeric_limits<double>::infinity(), size = 0;
  for (const Vec3d& p : points) {
    if (!isFinite(p)) throw usageError("a point to look at is not finite");
    const Vec3d d = p - origin;
    const double depth = dot(d, camera.forward);
    x.add(dot(d, camera.right), depth, tangentX);
    y.add(dot(d, camera.up), depth, tangentY);
    nearest = std::min(nearest, depth);
    size = std::max(size, length(d));
  }
  // Points on one line of sight would let the eye touch them: it keeps a hundredth of their size, or 1, away.
  const double away = size > 0 ? 0.01 * size : 1;
  const double depth = std::min({x.depth(tangentX), y.depth(tangentY), nearest - away});
  camera.eye = origin + camera.right * x.centre() + camera.up * y.centre() + camera.forward * depth;
  return camera;
}

}  // namespace shbake
