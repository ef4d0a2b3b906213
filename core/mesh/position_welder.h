// Equal positions found exactly.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// Numbers distinct positions in the order in which they first come. Positions are equal when their coordinates compare
/// equal: exactly, but -0 equals +0. An open hash table of at most 2/3 load beside the list of positions.
class PositionWelder {
 public:
  /// Makes room for `expected` distinct positions; more are fine.
  explicit PositionWelder(std::size_t expected = 0);

  /// The number of `p`, which is finite.
  std::uint32_t add(const Vec3d& p);

  /// The distinct positions by number, each as it first came.
  const std::vector<Vec3d>& positions() const { return positions_; }
  /// Moves the positions out, leaving the welder empty.
  std::vector<Vec3d> takePositions();

 private:
  std::size_t slotOf(const Vec3d& p) const;
  void grow(std::size_t slots);

  std::vector<Vec3d> positions_;
  std::vector<std::uint32_t> slots_;  // numbers of positions; a power of two of them
};

}  // namespace shbake
