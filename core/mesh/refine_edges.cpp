// Where the edges of flat patches are divided.
#include "mesh/refine_edges.h"

#include <algorithm>
#include <limits>

#include "mesh/flat_geometry.h"
#include "mesh/patch_points.h"

namespace shbake {

EdgeDivisions::EdgeDivisions(const Mesh& mesh, const EdgeTable& edges, const FlatPatches& patches,
                             const EdgeLength& length)
    : mesh_(mesh), edges_(edges), patches_(patches), length_(length), ofEdge_(edges.size(), kUnknown) {}

bool EdgeDivisions::isTooLong(std::uint32_t edge) const {
  const Vec3d low = position(edge, 0), high = position(edge, 1);
  return length(high - low) > kLongestEdge * lengthAt(edge, position(edge, 0.5));
}

std::size_t EdgeDivisions::divide(std::uint32_t edge, std::size_t most) {
  if (ofEdge_[edge] == kUnknown) {
    const std::span<const FaceSide> sides = edges_[edge];
    if (std::any_of(sides.begin(), sides.end(),
                    [this](FaceSide s) { return patches_.ofFace[s.face()] == FlatPatches::kNone; })) {
      ofEdge_[edge] = kWhole;
      return 0;
    }
    halve(edge, 0, 1, length(position(edge, 1) - position(edge, 0)), most);
    ofEdge_[edge] = static_cast<std::uint32_t>(starts_.size() - 1);
    starts_.push_back(shares_.size());
  }
  return of(edge).size();
}

std::span<const double> EdgeDivisions::of(std::uint32_t edge) const {
  const std::uint32_t list = ofEdge_[edge];
  if (list == kUnknown || list == kWhole) return {};
  return {shares_.data() + starts_[list], shares_.data() + starts_[list + 1]};
}

/// Shares are few-bit fractions, so that halves and quarters of an edge are exact where its coordinates allow it.
Vec3d EdgeDivisions::position(std::uint32_t edge, double share) const {
  FaceSide side = edges_[edge][0];
  const bool ascends = edges_.ascends(side);
  const auto at = [this](std::uint32_t corner) { return mesh_.positions[mesh_.triangles[corner / 3][corner % 3]]; };
  const Vec3d low = at(ascends ? side.first() : side.second()), high = at(ascends ? side.second() : side.first());
  return share == 0 ? low : share == 1 ? high : storedPosition(mesh_, low + (high - low) * share);
}

double EdgeDivisions::lengthAt(std::uint32_t edge, const Vec3d& place) const {
  double least = std::numeric_limits<double>::infinity();
  for (const FaceSide s : edges_[edge]) {
    if (patches_.ofFace[s.face()] == FlatPatches::kNone) continue;
    least = std::min(least, edgeLengthAt(mesh_, length_, s.face(), place));
  }
  return least;
}

/// Appends the places between `begin` and `end`, which are `length` apart.
void EdgeDivisions::halve(std::uint32_t edge, double begin, double end, double length, std::size_t most) {
  const double middle = (begin + end) / 2;
  if (length <= kLongestEdge * lengthAt(edge, position(edge, middle))) return;
  if (shares_.size() - starts_.back() > most) return;
  halve(edge, begin, middle, length / 2, most);
  shares_.push_back(middle);
  halve(edge, middle, end, length / 2, most);
}

}  // namespace shbake
