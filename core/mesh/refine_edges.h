// Where the edges of flat patches are divided: alike for all faces on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/flat_edges.h"
#include "mesh/flat_patches.h"
#include "mesh/mesh.h"
#include "mesh/refine_length.h"

namespace shbake {

/// Divides edges by halving, as the least length that any of its faces asks for wants it. An edge with a face that is
/// in no patch, or in one that must be left as it is, is never divided. All but the object must outlive it.
class EdgeDivisions {
 public:
  EdgeDivisions(const Mesh& mesh, const EdgeTable& edges, const FlatPatches& patches, const EdgeLength& length);

  /// Whether the edge is longer than its faces want, be it divided or not.
  bool isTooLong(std::uint32_t edge) const;
  /// Finds the places where the edge is to be divided, at the first call; returns how many there are. Throws what
  /// edgeLengthAt() throws; stops early beyond `most`.
  std::size_t divide(std::uint32_t edge, std::size_t most);
  /// Makes the edge stay as it is from now on.
  void keepWhole(std::uint32_t edge) { ofEdge_[edge] = kWhole; }

  /// The places where the edge has been divided, as shares of the way from its lesser to its greater point, ascending.
  std::span<const double> of(std::uint32_t edge) const;
  /// The position at a share of the way along the edge, as the file will hold it.
  Vec3d position(std::uint32_t edge, double share) const;

 private:
  static constexpr std::uint32_t kUnknown = 0xFFFFFFFFu, kWhole = 0xFFFFFFFEu;

  double lengthAt(std::uint32_t edge, const Vec3d& place) const;
  void halve(std::uint32_t edge, double begin, double end, double length, std::size_t most);

  const Mesh& mesh_;
  const EdgeTable& edges_;
  const FlatPatches& patches_;
  const EdgeLength& length_;
  std::vector<std::uint32_t> ofEdge_;  // numbers of lists
  std::vector<std::size_t> starts_{0};
  std::vector<double> shares_;
};

}  // namespace shbake
