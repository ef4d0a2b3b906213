// Faces that meet at a position, clustered into fans. Cutting a surface where it is not manifold follows the idea of
// Gueziec, Taubin, Lazarus, Horn, "Cutting and stitching: converting sets of polygons to manifold surfaces", IEEE TVCG
// 7 (2001): singular edges are cut, and what still hangs together at a position makes one vertex.
#include "mesh/face_fans.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

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

// Edges of more faces than this are cut altogether, which bounds the time that one edge can take.
constexpr std::size_t kMostFacesAtEdge = 16;

class EdgePairing {
 public:
  EdgePairing(const std::vector<Vec3f>& positions, const std::vector<Triangle>& faces)
      : opposite_(3 * faces.size(), kNoCorner), positions_(positions), faces_(faces) {}

  void addEdge(std::span<const Spoke> edge) {
    if (edge.size() == 2 && edge[0].outgoing != edge[1].outgoing) pair(edge[0], edge[1]);
    if (edge.size() > 2 && edge.size() <= kMostFacesAtEdge) pairSmoothest(edge);
  }

  std::vector<std::uint32_t> result() { return std::move(opposite_); }

 private:
  void pair(const Spoke& a, const Spoke& b) {
    opposite_[a.halfEdge] = b.halfEdge;
    opposite_[b.halfEdge] = a.halfEdge;
  }

  // Both sides of a doubled sheet go on smoothly this way, as does a floor on whose edge a wall stands.
  void pairSmoothest(std::span<const Spoke> edge) {
    normals_.clear();
    for (const Spoke& s : edge) normals_.push_back(faceNormal(positions_, faces_[s.halfEdge / 3]));
    for (std::size_t i = 0; i < edge.size(); ++i) {
      if (!edge[i].outgoing) continue;
      const std::size_t j = smoothest(edge, i);
      if (j < edge.size() && smoothest(edge, j) == i) pair(edge[i], edge[j]);
    }
  }

  // The half-edge in the other direction whose face bends least against that of edge[i]; edge.size() when there is none
  // or several bend alike.
  std::size_t smoothest(std::span<const Spoke> edge, std::size_t i) const {
    std::size_t best = edge.size();
    double cosine = -2;
    for (std::size_t j = 0; j < edge.size(); ++j) {
      if (edge[j].outgoing == edge[i].outgoing) continue;
      const double c = dot(normals_[i], normals_[j]);
      if (c == cosine) best = edge.size();
      if (c > cosine) best = j;
      cosine = std::max(cosine, c);
    }
    return best;
  }

  std::vector<std::uint32_t> opposite_;
  const std::vector<Vec3f>& positions_;
  const std::vector<Triangle>& faces_;
  std::vector<Vec3d> normals_;
};

}  // namespace

PackedLists cornersAtPositions(const std::vector<Triangle>& faces, std::size_t positions, Passes& passes) {
  PackedLists lists;
  lists.starts.assign(positions + 1, 0);
  lists.items.resize(3 * faces.size());
  passes.forEach(faces.size(), [&](std::size_t f) {
    for (const std::uint32_t p : faces[f]) ++lists.starts[p + 1];
  });
  passes.forEach(positions, [&](std::size_t p) { lists.starts[p + 1] += lists.starts[p]; });
  // Filling moves each start to the next list's; shifting them back by one place restores them.
  passes.forEach<std::uint32_t>(lists.items.size(),
                                [&](std::uint32_t c) { lists.items[lists.starts[positionAt(faces, c)]++] = c; });
  passes.forEach(positions, [&](std::size_t i) { lists.starts[positions - i] = lists.starts[positions - i - 1]; });
  lists.starts[0] = 0;
  return lists;
}

Vec3d faceNormal(const std::vector<Vec3f>& positions, const Triangle& face) {
  const auto first = static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
  const Vec3d a(positions[face[first]]), b(positions[face[(first + 1) % 3]]), c(positions[face[(first + 2) % 3]]);
  return normalized(cross(b - a, c - a));
}

std::vector<std::uint32_t> oppositeHalfEdges(const std::vector<Vec3f>& positions, const std::vector<Triangle>& faces,
                                             const PackedLists& corners, Passes& passes) {
  EdgePairing pairing(positions, faces);
  std::vector<Spoke> spokes;
  passes.forEach<std::uint32_t>(corners.size(), [&](std::uint32_t p) {
    collectSpokes(faces, corners[p], p, spokes);
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
      while (end < spokes.size() && spokes[end].otherEnd == spokes[begin].otherEnd) ++end;
      pairing.addEdge({spokes.data() + begin, end - begin});
    }
  });
  return pairing.result();
}

FaceFans faceFans(const std::vector<Triangle>& faces, const std::vector<std::uint32_t>& opposite, Passes& passes) {
  FaceFans fans;
  fans.ofCorner.assign(opposite.size(), kNoCorner);
  // Around a position, a corner's neighbour clockwise lies across its outgoing half-edge, the other across its incoming
  // one.
  const auto clockwise = [&](std::uint32_t c) {
    return opposite[c] == kNoCorner ? kNoCorner : nextCorner(opposite[c]);
  };
  const auto counterClockwise = [&](std::uint32_t c) { return opposite[previousCorner(c)]; };
  passes.forEach<std::uint32_t>(opposite.size(), [&](std::uint32_t c) {
    if (fans.ofCorner[c] != kNoCorner || isDegenerate(faces[c / 3])) return;
    std::uint32_t first = c;
    for (std::uint32_t back = clockwise(c); back != kNoCorner && back != c; back = clockwise(back)) first = back;
    const auto fan = static_cast<std::uint32_t>(fans.position.size());
    fans.position.push_back(positionAt(faces, c));
    for (std::uint32_t at = first; at != kNoCorner && fans.ofCorner[at] == kNoCorner; at = counterClockwise(at)) {
      fans.ofCorner[at] = fan;
    }
  });
  fans.position.shrink_to_fit();
  return fans;
}

}  // namespace shbake
