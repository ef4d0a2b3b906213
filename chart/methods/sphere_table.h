// Directions over the whole sphere, shared by all points, with the SH basis tabulated over them: what the loops of
// other programs sum with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace shbake::chart {

/// The direction of the sphere that belongs to a point of the unit square, area-preserving.
Vec3d sphereDirection(double x, double y);

class SphereTable {
 public:
  SphereTable(const std::vector<Vec3d>& directions, int order);

  std::size_t size() const { return directions_.size(); }
  const Vec3f& direction(std::size_t i) const { return directions_[i]; }
  /// sum[k] += weight * y_k(direction(i)); `sum` holds stride() floats.
  void add(std::size_t i, float weight, float* sum) const;
  std::size_t stride() const { return stride_; }

 private:
  std::size_t stride_;
  std::vector<Vec3f> directions_;
  std::vector<float> rows_;
};

/// The sum over up to N directions in float, moved to double every 1024, times a factor at the end.
class SphereSum {
 public:
  explicit SphereSum(const SphereTable& table) : table_(table), part_(table.stride()), total_(table.stride()) {}

  void clear();
  void add(std::size_t i, float weight);
  /// Writes factor * sum, order^2 values.
  void finish(double factor, std::span<float> out);

 private:
  void flush();

  const SphereTable& table_;
  std::vector<float> part_;
  std::vector<double> total_;
  int added_ = 0;
};

}  // namespace shbake::chart
