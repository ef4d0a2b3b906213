// Barycentric weights in the Delaunay simplices of a set of points.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// Up to four corners and their weights; unused ones have index -1.
struct SimplexWeights {
  std::array<int, 4> corner{-1, -1, -1, -1};
  std::array<double, 4> weight{};
};

/// The Delaunay triangulation of points in space: tetrahedra, or triangles, segments or a single point where all points
/// lie in a plane, on a line or in one place.
class DelaunaySimplices {
 public:
  /// Points must be finite. Of points in one place the first is kept.
  explicit DelaunaySimplices(std::span<const Vec3d> points);
  ~DelaunaySimplices();

  /// Barycentric weights of `place`, or of the nearest point of the convex hull where it lies outside. Not negative,
  /// sum 1 to rounding.
  SimplexWeights weightsAt(const Vec3d& place) const;

 private:
  struct Triangulation;
  std::unique_ptr<Triangulation> triangulation_;
};

/// The point of the triangle (a, b, c) nearest to `place`, as barycentric weights, clamped to the triangle. Corners may
/// coincide or lie on a line.
std::array<double, 3> nearestOnTriangle(const Vec3d& place, const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace shbake
