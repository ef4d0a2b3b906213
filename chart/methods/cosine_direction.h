// Cosine-distributed directions from points of the unit square.
#pragma once

#include <vector>

#include "bake/direction_set.h"
#include "base/vec3.h"

namespace shbake::chart {

/// The direction of the cosine-weighted hemisphere that belongs to a point of the unit square: the map of squares to
/// rings of P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", JGT 2 (1997), lifted to the sphere.
Vec3d cosineDirection(double x, double y);

/// N directions at cosineDirection(point(i)) with equal weights.
template <class Point>
std::vector<WeightedDirection> cosineDirections(int n, const Point& point) {
  std::vector<WeightedDirection> all;
  for (int i = 0; i < n; ++i) {
    const auto [x, y] = point(i);
    all.push_back({cosineDirection(x, y), 1.0 / n});
  }
  return all;
}

}  // namespace shbake::chart
