// Edge lengths wanted on the flat regions of a mesh: as they are, and finer where it was asked for.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <unordered_set>

#include "base/vec3.h"

namespace shbake {

/// One octree a region, all over the same cube. A cell of level L is 2^-L of the cube wide and wants edges no longer
/// than that. Cells of successive levels surround each other, so that lengths grow in proportion to the distance from
/// where the finest are wanted: an edge that is bounded at its ends suits what lies between them.
class LengthField {
 public:
  /// Beyond this level cells are no longer told apart by double precision of the places in them.
  static constexpr int kMostLevels = 20;

  struct Cell {
    std::uint32_t region;
    std::uint32_t level;
    std::uint32_t x, y, z;

    friend auto operator<=>(const Cell&, const Cell&) = default;
  };

  /// The cube from `low` with edges of `size` > 0; places outside count as at its border.
  LengthField(const Vec3d& low, double size) : low_(low), size_(size) {}

  double lengthOf(std::uint32_t level) const { return size_ / static_cast<double>(std::uint64_t(1) << level); }
  /// The level whose cells are nearest in width to `length` > 0, by ratio; 0..kMostLevels.
  std::uint32_t levelOf(double length) const;
  Cell cellAt(std::uint32_t region, const Vec3d& place, std::uint32_t level) const;
  /// The level wanted at a place; 0: nothing was asked for.
  std::uint32_t levelAt(std::uint32_t region, const Vec3d& place) const;

  /// Asks for the length of the cell's level within it.
  void want(const Cell& cell);
  std::size_t cells() const { return wanted_.size(); }

 private:
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };

  Vec3d low_;
  double size_;
  std::unordered_set<Cell, Hash> wanted_;
};

}  // namespace shbake
