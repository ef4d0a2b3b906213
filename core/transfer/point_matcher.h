// Finding the same lighting point in two files: by position and normal, in a grid of cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/passes.h"
#include "base/vec3.h"

namespace shbake {

/// Looks up points by position and normal. Borrows both arrays.
class PointMatcher {
 public:
  /// Positions match within this share of the largest side of the points' bounding box: ten times the rounding of a
  /// coordinate to float, and far below the length of any edge that light could tell.
  static constexpr double kRelativeDistance = 1e-6;
  /// Normals match within this angle in radians: turning a point by it changes its transfer by less than 0.01 %.
  static constexpr double kAngle = 1e-4;

  /// `normals` has one unit normal for each of `positions`. Far from the origin, where floats are coarser than
  /// kRelativeDistance, positions match within four units in the last place of the largest coordinate. Two passes.
  PointMatcher(const std::vector<Vec3d>& positions, const std::vector<Vec3f>& normals, Passes& passes);

  /// The nearest point that matches; of equally near ones that whose normal is nearest, then number `preferred`, then
  /// the lowest number. Nothing when none matches.
  std::optional<std::uint32_t> find(const Vec3d& position, const Vec3f& normal, std::uint32_t preferred) const;

  /// The distance, along each axis, within which positions match, in the units of the positions.
  double distance() const { return distance_; }

 private:
  std::uint64_t bucket(std::int64_t x, std::int64_t y, std::int64_t z) const;

  const std::vector<Vec3d>& positions_;
  const std::vector<Vec3f>& normals_;
  Vec3d low_, high_;  // the bounding box
  double distance_ = 0;
  double cell_ = 1;  // twice the distance: a search meets at most two cells along each axis
  std::uint64_t mask_ = 0;
  std::vector<std::uint32_t> heads_, next_;  // chains of the points in each bucket
};

}  // namespace shbake
