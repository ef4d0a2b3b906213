// Faces that meet at a position, clustered into fans. Cutting a surface where it is not manifold follows Gueziec,
// Taubin, Lazarus, Horn, "Cutting and stitching: converting sets of polygons to manifold surfaces", IEEE TVCG 7 (2001),
// section 4: edges that are no pair of half-edges are cut, and what still hangs together at a position makes one
// vertex.
#include "mesh/face_fans.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace shbake {
namespace {

// One half-edge at a position, listed by the position at its other end.
struct Spoke {
  std::uint32_t otherEnd;
  std::uint32_t halfEdge;
  bool outgoing;
};

// The half-edges between position `p` and positions of higher number, sorted by these.
void collectSpokes(const std::vector<Triangle>& faces, std::span<const std::uint32_t> corners, std::uint32_t p,
                   std::vector<Spoke>& spokes) {
  spokes.clear();
  for (const std::uint32_t c : corners) {
    if (isDegenerate(faces[c / 3])) continue;
    const std::uint32_t to = positionAt(faces, nextCorner(c)), from = positionAt(faces, previousCorner(c));
    if (to > p) spokes.push_back({to, c, true});
    if (from > p) spokes.push_back({from, previousCorner(c), false});
  }
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
    return std::tie(a.otherEnd, a.halfEdge) < std::tie(b.otherEnd, b.halfEdge);
  });
}

}  // namespace

PackedLists cornersAtPositions(const std::vector<Triangle>& faces, std::size_t positions) {
  PackedLists lists;
  lists.starts.assign(positions + 1, 0);
  lists.items.resize(3 * faces.size());
  for (const Triangle& face : faces) {
    for (const std::uint32_t p : face) ++lists.starts[p + 1];
  }
  for (std::size_t p = 0; p < positions; ++p) lists.starts[p + 1] += lists.starts[p];
  // Filling moves each start to the next list's; shifting them back by one place restores them.
  for (std::uint32_t c = 0; c < lists.items.size(); ++c) lists.items[lists.starts[positionAt(faces, c)]++] = c;
  for (std::size_t p = positions; p > 0; --p) lists.starts[p] = lists.starts[p - 1];
  lists.starts[0] = 0;
  return lists;
}

std::vector<std::uint32_t> oppositeHalfEdges(const std::vector<Triangle>& faces, const PackedLists& corners) {
  std::vector<std::uint32_t> opposite(3 * faces.size(), kNoCorner);
  std::vector<Spoke> spokes;
  for (std::uint32_t p = 0; p < corners.size(); ++p) {
    collectSpokes(faces, corners[p], p, spokes);
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
      while (end < spokes.size() && spokes[end].otherEnd == spokes[begin].otherEnd) ++end;
      const Spoke &first = spokes[begin], &last = spokes[end - 1];
      if (end - begin != 2 || first.outgoing == last.outgoing) continue;
      opposite[first.halfEdge] = last.halfEdge;
      opposite[last.halfEdge] = first.halfEdge;
    }
  }
  return opposite;
}

FaceFans faceFans(const std::vector<Triangle>& faces, const std::vector<std::uint32_t>& opposite) {
  FaceFans fans;
  fans.ofCorner.assign(opposite.size(), kNoCorner);
  // Around a position, a corner's neighbour clockwise lies across its outgoing half-edge, the other across its incoming
  // one.
  const auto clockwise = [&](std::uint32_t c) {
    return opposite[c] == kNoCorner ? kNoCorner : nextCorner(opposite[c]);
  };
  const auto counterClockwise = [&](std::uint32_t c) { return opposite[previousCorner(c)]; };
  for (std::uint32_t c = 0; c < opposite.size(); ++c) {
    if (fans.ofCorner[c] != kNoCorner || isDegenerate(faces[c / 3])) continue;
    std::uint32_t first = c;
    for (std::uint32_t back = clockwise(c); back != kNoCorner && back != c; back = clockwise(back)) first = back;
    const auto fan = static_cast<std::uint32_t>(fans.position.size());
    fans.position.push_back(positionAt(faces, c));
    for (std::uint32_t at = first; at != kNoCorner && fans.ofCorner[at] == kNoCorner; at = counterClockwise(at)) {
      fans.ofCorner[at] = fan;
    }
  }
  fans.position.shrink_to_fit();
  return fans;
}

}  // namespace shbake
