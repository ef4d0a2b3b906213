// The edges of a mesh by position, each with the sides of faces that lie on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/passes.h"
#include "mesh/edge_groups.h"
#include "mesh/mesh.h"

namespace shbake {

/// The edges of a mesh whose vertices at exactly equal positions count as one point, found from either end.
struct EdgeTable {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::vector<Triangle> faces;           ///< F triples of point numbers
  std::size_t points = 0;                ///< distinct positions
  std::vector<std::uint32_t> starts{0};  ///< of the sides of each edge
  std::vector<FaceSide> sides;           ///< of each edge, ascending by face
  std::vector<std::uint32_t> ofSide;     ///< 3F edge numbers; kNone for faces that repeat a point

  std::size_t size() const { return starts.size() - 1; }
  std::span<const FaceSide> operator[](std::size_t edge) const {
    return {sides.data() + starts[edge], sides.data() + starts[edge + 1]};
  }
  std::uint32_t pointAt(std::uint32_t corner) const { return faces[corner / 3][corner % 3]; }
  /// True when the side runs from the lesser to the greater point of its edge.
  bool ascends(FaceSide s) const { return pointAt(s.first()) < pointAt(s.second()); }

  /// The only other side on the edge of `s`; kNone where there is none or more than one.
  std::uint32_t partner(FaceSide s) const {
    if (ofSide[s.side] == kNone) return kNone;
    const std::span<const FaceSide> all = (*this)[ofSide[s.side]];
    if (all.size() != 2) return kNone;
    return all[0].side == s.side ? all[1].side : all[0].side;
  }
  /// The side across the edge where the surface goes on: the partner, if its face is wound alike; else kNone.
  std::uint32_t across(FaceSide s) const {
    const std::uint32_t other = partner(s);
    return other != kNone && ascends({other}) != ascends(s) ? other : kNone;
  }
};

/// The edges of a mesh with at most 1.4e9 faces, indices < V and finite positions, in an order that the order of its
/// vertices decides. kEdgeTablePasses passes.
EdgeTable edgeTableOf(const Mesh& mesh, Passes& passes);
inline constexpr int kEdgeTablePasses = 7;

}  // namespace shbake
