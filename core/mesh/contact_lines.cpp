#include "mesh/contact_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/passes.h"
#include "mesh/box_pairs.h"
#include "mesh/flat_geometry.h"

namespace shbake {
namespace {

struct PositionLess {
  bool operator()(const Vec3d& a, const Vec3d& b) const { return comesBefore(a, b); }
};

struct Segment {
  Vec3d a, b;
};

/// The part [begin, end] of a segment that a face makes on the plane of a patch.
struct Piece {
  std::uint32_t patch, face;
  std::uint32_t line;  // 0..2: that edge of the face; 3: across it
  double begin, end;
  Segment whole;

  auto key() const { return std::tuple(patch, face, line, begin, end); }
  bool isSameLine(const Piece& other) const { return patch == other.patch && face == other.face && line == other.line; }
  Vec3d at(double t) const { return t == 0 ? whole.a : t == 1 ? whole.b : whole.a + (whole.b - whole.a) * t; }
};

struct Plane {
  Vec3d normal, origin;
  double ulp = 0;

  double heightOf(const Vec3d& p) const { return dot(p - origin, normal); }
};

class LineFinder {
 public:
  LineFinder(const Mesh& mesh, const EdgeTable& edges, const FlatPatches& patches, Progress& progress)
      : mesh_(mesh), edges_(edges), patches_(patches), progress_(progress) {}

  std::vector<Piece> run() {
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      const FaceShape shape(mesh_, patches_[p][0]);
      planes_.push_back({shape.normal(), shape.corners[0], shape.ulp});
    }
    std::vector<std::uint32_t> flat;
    std::vector<Box> flatBoxes, boxes;
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
      boxes.push_back(boxOf(f));
      if (patches_.ofFace[f] == FlatPatches::kNone) continue;
      flat.push_back(f);
      flatBoxes.push_back(boxes.back());
    }
    std::size_t seen = 0;
    forEachMeeting(flatBoxes, boxes, [&](std::size_t i, std::size_t other) {
      if (++seen % kProgressBlock == 0) progress_.advance(0);
      meet(flat[i], static_cast<std::uint32_t>(other));
    });
    return std::move(pieces_);
  }

 private:
  const Vec3d& positionAt(std::uint32_t corner) const {
    return mesh_.positions[mesh_.triangles[corner / 3][corner % 3]];
  }

  Box boxOf(std::uint32_t face) const {
    const Triangle& t = mesh_.triangles[face];
    const Vec3d &a = mesh_.positions[t[0]], &b = mesh_.positions[t[1]], &c = mesh_.positions[t[2]];
    const double margin = kPlaneUlps * coordinateUlp(mesh_, std::max({magnitudeOf(a), magnitudeOf(b), magnitudeOf(c)}));
    const Vec3d by(margin, margin, margin);
    return {Vec3d(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})) - by,
            Vec3d(std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})) + by};
  }

  bool shareEdge(std::uint32_t f, std::uint32_t g) const {
    int shared = 0;
    for (const std::uint32_t p : edges_.faces[f]) {
      shared += std::count(edges_.faces[g].begin(), edges_.faces[g].end(), p) > 0;
    }
    return shared >= 2;
  }

  void meet(std::uint32_t face, std::uint32_t other) {
    const std::uint32_t patch = patches_.ofFace[face];
    if (patches_.ofFace[other] == patch || shareEdge(face, other)) return;
    const Plane& plane = planes_[patch];
    const FaceShape shape(mesh_, other);
    const double onPlane = kPlaneUlps * std::max(plane.ulp, shape.ulp);
    std::array<double, 3> height{};
    int above = 0, below = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      height[k] = plane.heightOf(shape.corners[k]);
      if (std::abs(height[k]) <= onPlane) height[k] = 0;
      above += height[k] > 0;
      below += height[k] < 0;
    }
    if (above == 0 && below == 0) return addBorders(face, other);
    if (above == 3 || below == 3) return;
    std::vector<Vec3d> ends;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = 3 * other + k, to = FaceSide{from}.second();
      if (height[k] == 0) ends.push_back(positionAt(from));
      if (height[k] * height[to % 3] < 0) ends.push_back(crossing(from, to, height[k], height[to % 3]));
    }
    if (ends.size() == 2) add(face, other, 3, {ends[0], ends[1]});
  }

  /// Where an edge crosses the plane: the same for both faces on it.
  Vec3d crossing(std::uint32_t from, std::uint32_t to, double heightFrom, double heightTo) const {
    Vec3d a = positionAt(from), b = positionAt(to);
    if (comesBefore(b, a)) {
      std::swap(a, b);
      std::swap(heightFrom, heightTo);
    }
    return a + (b - a) * (heightFrom / (heightFrom - heightTo));
  }

  /// A face lies on the plane: where another one goes on from it, that one tells of a line there, if there is any.
  void addBorders(std::uint32_t face, std::uint32_t other) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const FaceSide side{3 * other + k};
      const std::uint32_t edge = edges_.ofSide[side.side];
      if (edge == EdgeTable::kNone || edges_[edge].size() > 1) continue;
      add(face, other, k, {positionAt(side.first()), positionAt(side.second())});
    }
  }

  /// Adds what lies on the face.
  void add(std::uint32_t face, std::uint32_t other, std::uint32_t line, Segment s) {
    if (comesBefore(s.b, s.a)) std::swap(s.a, s.b);
    const FaceShape shape(mesh_, face);
    double begin = 0, end = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& corner = shape.corners[k];
      const Vec3d inwards = cross(shape.areaVector, shape.corners[(k + 1) % 3] - corner);
      const double atA = dot(s.a - corner, inwards), atB = dot(s.b - corner, inwards);
      if (atA < 0 && atB < 0) return;
      if (atA < 0) begin = std::max(begin, atA / (atA - atB));
      if (atB < 0) end = std::min(end, atA / (atA - atB));
    }
    if (begin < end) pieces_.push_back({patches_.ofFace[face], other, line, begin, end, s});
  }

  const Mesh& mesh_;
  const EdgeTable& edges_;
  const FlatPatches& patches_;
  Progress& progress_;
  std::vector<Plane> planes_;  // of the patches
  std::vector<Piece> pieces_;
};

/// Joins the pieces of a line that follow each other, be it that rounding has left a gap between them. Sorted by patch.
std::vector<std::pair<std::uint32_t, Segment>> joined(std::vector<Piece> pieces) {
  constexpr double kGap = 1e-9;
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.key() < b.key(); });
  std::vector<std::pair<std::uint32_t, Segment>> segments;
  for (std::size_t i = 0; i < pieces.size();) {
    const Piece& first = pieces[i];
    double end = first.end;
    for (++i; i < pieces.size() && pieces[i].isSameLine(first) && pieces[i].begin <= end + kGap; ++i) {
      end = std::max(end, pieces[i].end);
    }
    const Segment s{first.at(first.begin), first.at(end)};
    if (s.a != s.b) segments.push_back({first.patch, s});
  }
  // Two faces that meet on the patch make the same line.
  const auto key = [](const auto& s) {
    return std::tuple(s.first, s.second.a.x, s.second.a.y, s.second.a.z, s.second.b.x, s.second.b.y, s.second.b.z);
  };
  std::sort(segments.begin(), segments.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  segments.erase(
      std::unique(segments.begin(), segments.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      segments.end());
  return segments;
}

/// Chains segments at the places where just two of them end.
class Chainer {
 public:
  explicit Chainer(std::span<const std::pair<std::uint32_t, Segment>> segments)
      : segments_(segments), used_(segments.size()) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      at_[segments[i].second.a].push_back(i);
      at_[segments[i].second.b].push_back(i);
    }
  }

  void appendTo(std::vector<Polyline>& lines) {
    // First those with ends, then what is left: loops.
    for (const bool loops : {false, true}) {
      for (const auto& [place, segments] : at_) {
        if (!loops && segments.size() == 2) continue;
        for (const std::size_t s : segments) {
          if (!used_[s]) lines.push_back(follow(place, s));
        }
      }
    }
  }

 private:
  Polyline follow(const Vec3d& start, std::size_t segment) {
    Polyline line{{start}, false};
    for (;;) {
      used_[segment] = true;
      const Segment& s = segments_[segment].second;
      const Vec3d next = s.a == line.places.back() ? s.b : s.a;
      if (next == start) {
        line.closed = line.places.size() > 2;
        return line;
      }
      line.places.push_back(next);
      const std::vector<std::size_t>& here = at_.at(next);
      if (here.size() != 2) return line;
      const std::size_t onwards = here[0] == segment ? here[1] : here[0];
      if (used_[onwards]) return line;
      segment = onwards;
    }
  }

  std::span<const std::pair<std::uint32_t, Segment>> segments_;
  std::map<Vec3d, std::vector<std::size_t>, PositionLess> at_;
  std::vector<bool> used_;
};

}  // namespace

ContactLines findContactLines(const Mesh& mesh, const EdgeTable& edges, const FlatPatches& patches,
                              Progress& progress) {
  progress.begin("finding contacts", static_cast<double>(mesh.triangles.size()), "faces");
  const auto segments = joined(LineFinder(mesh, edges, patches, progress).run());
  ContactLines found;
  auto begin = segments.begin();
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    found.starts.push_back(static_cast<std::uint32_t>(found.lines.size()));
    const auto end = std::find_if(begin, segments.end(), [p](const auto& s) { return s.first != p; });
    Chainer({begin, end}).appendTo(found.lines);
    begin = end;
  }
  found.starts.push_back(static_cast<std::uint32_t>(found.lines.size()));
  progress.end();
  return found;
}

}  // namespace shbake
