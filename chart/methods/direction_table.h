// Directions of the local hemisphere with the SH basis tabulated over them: what all baselines sum with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "sh/local_frame.h"

namespace shbake::chart {

/// A direction above the tangent plane and the share of the cosine-weighted hemisphere that it stands for.
struct WeightedDirection {
  Vec3d direction;  ///< unit, z > 0 in the local frame
  double weight;    ///< the weights of a set sum to 1
};

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

/// A set sorted into tight groups of 16, as DirectionSet sorts its own, with w_i y_k(d_i) in float. The last group may
/// have fewer: activeMask() tells.
class DirectionTable {
 public:
  static constexpr int kGroup = 16;

  DirectionTable(std::vector<WeightedDirection> set, int order);

  int size() const { return size_; }
  int groups() const { return static_cast<int>(masks_.size()); }
  int order() const { return order_; }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  float lowestZ(int group) const { return lowestZ_[static_cast<std::size_t>(group)]; }
  /// Bits of the directions that a group has.
  std::uint16_t activeMask(int group) const { return masks_[static_cast<std::size_t>(group)]; }

  /// sum over the directions whose bit is set in `sky` of w_i y_k(d_i), order^2 values in the local frame.
  void sum(std::span<const std::uint16_t> sky, std::span<double> local) const;

 private:
  int order_, size_;
  std::size_t stride_;
  std::vector<float> x_, y_, z_, lowestZ_;
  std::vector<std::uint16_t> masks_;
  std::vector<float> rows_, groupSums_;
};

}  // namespace shbake::chart
