// The directions that every lighting point looks along, and the SH basis tabulated over them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// A direction above the tangent plane and the share of the cosine-weighted hemisphere that it stands for.
struct WeightedDirection {
  Vec3d direction;  ///< unit, z > 0 in the local frame
  double weight;    ///< the weights of a set sum to 1
};

/// A cosine-distributed Fibonacci lattice over the hemisphere of a local frame whose z axis is the normal.
/// Point i of N has cos^2(theta) = 1 - (i + 1/2)/N and azimuth 2 pi i / golden ratio, so that every direction stands
/// for the same share pi/N of the cosine-weighted hemisphere (Swinbank, Purser, "Fibonacci grids", 2006, mapped to the
/// disc; Malley's method). The set is cut into tight groups of 16 that are traced together; within a group the
/// directions stand in a 4 x 4 grid, row by row, so that bits next to each other in a group's mask are next to each
/// other on the sphere.
class DirectionSet {
 public:
  static constexpr int kGroup = 16;

  /// `rays` >= 1 is rounded up to a multiple of 16; `order` as for sh::evaluate.
  DirectionSet(int rays, int order);
  /// Other directions, to compare with: one or more, filled up to a multiple of 16 with some of no weight. Rows of
  /// basis() are multiplied by size() times the weight; unshadowed() is the directions' own sum and residual() zero, so
  /// that no control variate is added.
  DirectionSet(std::vector<WeightedDirection> directions, int order);

  int size() const { return static_cast<int>(x_.size()); }
  int groups() const { return size() / kGroup; }
  int order() const { return order_; }
  /// order^2 rounded up so that rows can be added in whole vectors; the excess is zero.
  std::size_t stride() const { return stride_; }

  /// Local unit vectors, size() of each component, z > 0.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  /// The smallest z of a group: all its directions rise at least this far above the tangent plane.
  float lowestZ(int group) const { return lowestZ_[static_cast<std::size_t>(group)]; }

  /// y_k of direction i for k < order^2, then zeros to stride(). (Of other directions, times their weight.)
  const float* basis(int i) const { return basis_.data() + static_cast<std::size_t>(i) * stride_; }
  /// The sum of basis() over a group.
  const float* groupSum(int group) const { return groupSums_.data() + static_cast<std::size_t>(group) * stride_; }
  /// Exact unshadowed transfer of albedo 1 minus the lattice's own, order^2 values: what the control variate adds.
  std::span<const double> residual() const { return residual_; }
  /// Exact unshadowed transfer of albedo 1 in the local frame, order^2 values.
  std::span<const double> unshadowed() const { return unshadowed_; }

 private:
  std::vector<double> tabulate(std::vector<WeightedDirection> directions);

  int order_;
  std::size_t stride_;
  std::vector<float> x_, y_, z_, lowestZ_;
  std::vector<float> basis_, groupSums_;
  std::vector<double> residual_, unshadowed_;
};

}  // namespace shbake
