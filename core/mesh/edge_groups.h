// The edges of a triangle list, each with all its faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/passes.h"
#include "mesh/mesh.h"

namespace shbake {

/// The side of a face from its corner c to the next one, as the number 3 * face + c.
struct FaceSide {
  std::uint32_t side;

  std::uint32_t face() const { return side / 3; }
  /// The corners (3 * face + 0..2) at its beginning and end.
  std::uint32_t first() const { return side; }
  std::uint32_t second() const { return side % 3 == 2 ? side - 2 : side + 1; }
};

/// Sides of faces grouped by the edge that they lie on, whichever way they run. Any number of faces may share an edge.
/// Two sorted arrays: 8 bytes a side and 8 a point.
class EdgeGroups {
 public:
  /// `faces` are triples of point numbers below `points`; faces with a number twice have no sides. `faces` must outlive
  /// the object. At most 1.4e9 faces. Four passes.
  EdgeGroups(std::span<const Triangle> faces, std::size_t points, Passes& passes);

  /// Calls `visit(std::span<const FaceSide>)` for each edge, in ascending order of its lesser and greater point; the
  /// sides of an edge ascend by face. One pass.
  template <class Visit>
  void forEach(Passes& passes, Visit&& visit) const {
    std::vector<FaceSide> group;
    passes.forEach(starts_.size() - 1, [&](std::size_t low) {
      for (std::size_t i = starts_[low]; i < starts_[low + 1];) {
        const std::uint32_t high = sides_[i].high;
        group.clear();
        for (; i < starts_[low + 1] && sides_[i].high == high; ++i) group.push_back({sides_[i].side});
        visit(std::span<const FaceSide>(group));
      }
    });
  }

  /// The point at a corner (3 * face + 0..2).
  std::uint32_t pointOf(std::uint32_t corner) const { return faces_[corner / 3][corner % 3]; }
  /// True when the side runs from the lesser to the greater point of its edge.
  bool ascends(FaceSide s) const { return pointOf(s.first()) < pointOf(s.second()); }

 private:
  struct Side {
    std::uint32_t high, side;
  };

  std::span<const Triangle> faces_;
  std::vector<std::uint64_t> starts_;  // of each lesser point in sides_
  std::vector<Side> sides_;
};

/// Two numbers of a face's points are equal.
constexpr bool repeatsPoint(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace shbake
