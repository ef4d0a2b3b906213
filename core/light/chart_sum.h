// Sums of colour times y_lm over points of a chart, many points at once.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "light/map_layout.h"

namespace shbake {

/// Adds colour times y_lm times the solid angle per area of points (s, t) of a chart, both -1..1. Points are collected
/// and evaluated in blocks, which vector units do several at a time; a point and its mirror image (-s, t) are evaluated
/// once, since each y_lm is either even or odd under the mirroring.
class ChartSum {
 public:
  /// Collects points of `chart`, which is a face of a cube or, for `layout` angular, the whole map. Adds to `sum`
  /// (order^2 coefficients), which must outlive it, when a block is full and in flush().
  ChartSum(MapLayout layout, const CubeFace& chart, int order, std::span<Vec3d> sum);

  void add(double s, double t, const Vec3d& color) { append(s, t, color, color); }
  /// The point (s, t) and its mirror image (-s, t).
  void addPair(double s, double t, const Vec3d& color, const Vec3d& mirrored) {
    append(s, t, color + mirrored, color - mirrored);
  }
  void flush();

 private:
  static constexpr std::size_t kBlock = 64;
  using Values = std::array<double, kBlock>;
  using Colors = std::array<Values, 3>;

  void append(double s, double t, const Vec3d& even, const Vec3d& odd);
  void findDirections();
  void addBand(int m);

  bool angular_, mirrorsX_;
  int order_;
  CubeFace chart_;
  std::span<Vec3d> sum_;
  std::vector<double> factors_;  ///< a and b of the recurrence for l = 1..order-1 and m < l, l by l, then q_mm by m
  std::size_t count_ = 0;
  alignas(64) Values s_, t_;
  alignas(64) Values x_, y_, z_;
  alignas(64) Colors even_, odd_;  ///< colours that meet y_lm of either kind
  alignas(64) Values cosine_, sine_;
  alignas(64) Colors cosineColors_, sineColors_;  ///< colours times cos m phi and sin m phi
};

}  // namespace shbake
