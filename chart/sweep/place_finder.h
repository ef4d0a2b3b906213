// Where a place of the surface lies on another mesh of the same surface.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bake/surface_places.h"
#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake::chart {

/// Triangles of points with positions and normals.
struct PointSurface {
  std::vector<Vec3f> positions;  ///< of each point
  std::vector<Vec3f> normals;    ///< unit, of each point
  std::vector<Triangle> faces;   ///< triples of points
};

/// Finds the nearest face of a surface (Embree's point queries).
class PlaceFinder {
 public:
  /// `surface` must outlive it. Throws a work error where Embree fails.
  explicit PlaceFinder(const PointSurface& surface);
  ~PlaceFinder();

  /// The place nearest to `position` on faces whose normal there is less than a right angle from `normal`: of two
  /// sheets in one place the right one. Any number of threads may ask at once. Throws a work error where no face looks
  /// that way.
  SurfacePlace nearest(const Vec3f& position, const Vec3f& normal) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace shbake::chart
