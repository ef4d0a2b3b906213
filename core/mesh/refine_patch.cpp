// One flat patch, cut anew.
#include "mesh/refine_patch.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "mesh/flat_geometry.h"
#include "mesh/patch_points.h"
#include "mesh/patch_rows.h"

namespace shbake {
namespace {

/// Axes in the plane of a patch.
struct PatchFrame {
  Vec3d origin, u, v, n;

  Point2 project(const Vec3d& p) const { return {dot(p - origin, u), dot(p - origin, v)}; }
  double heightOf(const Vec3d& p) const { return dot(p - origin, n); }
  Vec3d lift(Point2 p, double height) const { return origin + u * p.x + v * p.y + n * height; }
};

class PatchWork {
 public:
  PatchWork(const PatchSource& source, std::uint32_t patch, bool rowsAlone)
      : s_(source), faces_(source.patches[patch]), contacts_(source.contacts[patch]), rowsAlone_(rowsAlone) {}

  std::optional<PatchMesh> run() {
    numberVertices();
    findBorder();
    placeFrame();
    divideBorder();
    PatchLocator locator(places_, localFaces_, s_.countDone);
    if (!locator.valid()) return std::nullopt;
    addEdgePoints();
    addInnerPoints(locator);
    if (out_.edgePoints.empty() && out_.innerPositions.empty()) return std::move(out_);
    std::optional<std::vector<Triangle>> faces = triangulatePatch(places_, pieces_, rows_, s_.countDone);
    if (!faces && !rows_.empty()) faces = triangulatePatch(places_, pieces_, {}, s_.countDone);
    if (!faces) return std::nullopt;
    out_.faces = std::move(*faces);
    for (Triangle& t : out_.faces) {
      out_.sourceFace.push_back(sourceOf(t, locator));
      if (turned_) std::swap(t[1], t[2]);
    }
    return std::move(out_);
  }

 private:
  void numberVertices();
  void findBorder();
  void placeFrame();
  void divideBorder();
  void addEdgePoints();
  void addInnerPoints(PatchLocator& locator);
  void addInnerPoint(const PatchPoint& point);
  std::vector<PatchLine> linesOnPlane() const;
  std::vector<PatchObstacle> obstacles() const;
  std::uint32_t sourceOf(const Triangle& t, PatchLocator& locator) const;

  std::uint32_t vertexAt(std::uint32_t corner) const { return s_.mesh.triangles[corner / 3][corner % 3]; }
  const Vec3d& positionAt(std::uint32_t corner) const { return s_.mesh.positions[vertexAt(corner)]; }
  double lengthAt(std::uint32_t face, const Vec3d& place) const {
    return edgeLengthAt(s_.mesh, s_.length, face, place);
  }

  const PatchSource& s_;
  std::span<const std::uint32_t> faces_;
  std::span<const Polyline> contacts_;
  bool rowsAlone_;
  PatchMesh out_;
  PatchFrame frame_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;  // of vertices of the mesh
  bool turned_ = false;                                       // the faces are clockwise in the frame
  std::vector<Triangle> localFaces_;  // the faces as they were, by point numbers, counter-clockwise in the frame
  std::vector<FaceSide> border_;
  std::vector<std::array<std::uint32_t, 2>> pieces_;  // of the border, as divided
  std::vector<std::uint32_t> pieceFace_;
  std::vector<std::array<std::uint32_t, 2>> rows_;  // pairs of points along contact lines
  std::vector<Point2> places_;                      // of all points
  std::vector<std::uint32_t> faceAtPoint_;          // a face of the mesh that each point lies on
};

void PatchWork::numberVertices() {
  for (const std::uint32_t f : faces_) {
    Triangle local{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = s_.mesh.triangles[f][k];
      const auto [found, isNew] = numbers_.try_emplace(v, static_cast<std::uint32_t>(out_.vertices.size()));
      if (isNew) {
        out_.vertices.push_back(v);
        faceAtPoint_.push_back(f);
      }
      local[k] = found->second;
    }
    localFaces_.push_back(local);
  }
}

void PatchWork::findBorder() {
  for (const std::uint32_t f : faces_) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      if (isPatchBorder(s_.edges, s_.patches, s_.attributes, {3 * f + c})) border_.push_back({3 * f + c});
    }
  }
}

/// Rows of new points run along the longest piece of the border, and begin on it. The frame depends on positions alone,
/// so that the other side of a doubled sheet has the same; there, faces are wound clockwise in it.
void PatchWork::placeFrame() {
  const auto endsOf = [this](FaceSide side) {
    std::array<Vec3d, 2> ends{positionAt(side.first()), positionAt(side.second())};
    if (comesBefore(ends[1], ends[0])) std::swap(ends[0], ends[1]);
    return ends;
  };
  std::array<Vec3d, 2> longest = endsOf({3 * faces_[0]});
  double most = 0;
  for (const FaceSide side : border_) {
    const std::array<Vec3d, 2> ends = endsOf(side);
    const double size = length(ends[1] - ends[0]);
    if (size < most) continue;
    if (size > most ||
        std::lexicographical_compare(ends.begin(), ends.end(), longest.begin(), longest.end(), comesBefore)) {
      longest = ends;
    }
    most = size;
  }
  frame_.origin = longest[0];
  frame_.n = FaceShape(s_.mesh, faces_[0]).normal();
  turned_ = comesBefore(frame_.n, Vec3d());
  if (turned_) frame_.n = -frame_.n;
  const Vec3d along = longest[1] - longest[0];
  frame_.u = normalized(along - frame_.n * dot(along, frame_.n));
  frame_.v = cross(frame_.n, frame_.u);
  for (const std::uint32_t v : out_.vertices) places_.push_back(frame_.project(s_.mesh.positions[v]));
  if (!turned_) return;
  for (Triangle& t : localFaces_) std::swap(t[1], t[2]);
}

/// Cuts the border into pieces, and numbers the points between them. Where both sides of an edge are border, they
/// share its points.
void PatchWork::divideBorder() {
  auto next = static_cast<std::uint32_t>(out_.vertices.size());
  std::unordered_map<std::uint32_t, std::uint32_t> firstOnEdge;
  for (const FaceSide side : border_) {
    const std::uint32_t edge = s_.edges.ofSide[side.side];
    const auto count = static_cast<std::uint32_t>(s_.divisions.of(edge).size());
    const auto [first, isNew] = firstOnEdge.try_emplace(edge, next);
    if (isNew) {
      next += count;
      for (std::uint32_t i = 0; i < count; ++i) out_.edgePoints.push_back({side.side, i});
    }
    std::uint32_t from = numbers_[vertexAt(side.first())];
    for (std::uint32_t i = 0; i <= count; ++i) {
      const std::uint32_t step = s_.edges.ascends(side) ? i : count - 1 - i;
      const std::uint32_t to = i == count ? numbers_[vertexAt(side.second())] : first->second + step;
      pieces_.push_back(turned_ ? std::array{to, from} : std::array{from, to});
      pieceFace_.push_back(side.face());
      from = to;
    }
  }
}

void PatchWork::addEdgePoints() {
  for (const PatchMesh::EdgePoint& point : out_.edgePoints) {
    const std::uint32_t edge = s_.edges.ofSide[point.side];
    places_.push_back(frame_.project(s_.divisions.position(edge, s_.divisions.of(edge)[point.index])));
    faceAtPoint_.push_back(point.side / 3);
  }
}

/// The pieces of the border, and the vertices inside, which stay where they are.
std::vector<PatchObstacle> PatchWork::obstacles() const {
  std::vector<PatchObstacle> all;
  std::vector<bool> onBorder(places_.size());
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto& [from, to] = pieces_[i];
    onBorder[from] = onBorder[to] = true;
    const Point2 a = places_[from], b = places_[to];
    const Vec3d middle = frame_.lift({(a.x + b.x) / 2, (a.y + b.y) / 2}, 0);
    all.push_back({a, b, lengthAt(pieceFace_[i], middle)});
  }
  for (std::uint32_t i = 0; i < out_.vertices.size(); ++i) {
    if (onBorder[i]) continue;
    all.push_back({places_[i], places_[i], lengthAt(faceAtPoint_[i], s_.mesh.positions[out_.vertices[i]])});
  }
  return all;
}

void PatchWork::addInnerPoints(PatchLocator& locator) {
  const PatchLength wanted = [this](std::uint32_t local, Point2 p) {
    return lengthAt(faces_[local], frame_.lift(p, 0));
  };
  std::vector<PatchObstacle> keptClear = obstacles();
  const PatchRows rows = rowsBeside(locator, linesOnPlane(), s_.rowOffset, keptClear, wanted);
  keptClear.insert(keptClear.end(), rows.pieces.begin(), rows.pieces.end());
  s_.countNew(rows.points.size());
  const auto first = static_cast<std::uint32_t>(places_.size());
  for (const auto& [from, to] : rows.joints) rows_.push_back({first + from, first + to});
  for (const PatchPoint& point : rows.points) addInnerPoint(point);
  if (rowsAlone_) return;
  for (const PatchPoint& point : spreadPoints(locator, keptClear, wanted, s_.countNew)) addInnerPoint(point);
}

std::vector<PatchLine> PatchWork::linesOnPlane() const {
  std::vector<PatchLine> lines;
  for (const Polyline& contact : contacts_) {
    PatchLine& line = lines.emplace_back();
    line.closed = contact.closed;
    for (const Vec3d& place : contact.places) line.places.push_back(frame_.project(place));
  }
  return lines;
}

void PatchWork::addInnerPoint(const PatchPoint& point) {
  const std::uint32_t f = faces_[point.face];
  const FaceShape shape(s_.mesh, f);
  Blend blend = blendAt(shape.corners, frame_.lift(point.place, 0));
  const auto& c = shape.corners;
  const double height = blend.apply(frame_.heightOf(c[0]), frame_.heightOf(c[1]), frame_.heightOf(c[2]));
  const Vec3d position = storedPosition(s_.mesh, frame_.lift(point.place, height));
  blend.a = vertexAt(3 * f);
  blend.b = vertexAt(3 * f + 1);
  blend.c = vertexAt(3 * f + 2);
  out_.innerBlends.push_back(blend);
  out_.innerPositions.push_back(position);
  places_.push_back(frame_.project(position));
  faceAtPoint_.push_back(f);
}

/// The face that a new one's centroid lies in. Along a border that rounding has moved it may be beside all faces.
std::uint32_t PatchWork::sourceOf(const Triangle& t, PatchLocator& locator) const {
  const Point2 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
  const std::uint32_t local = locator.find({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
  if (local != PatchLocator::kNone) return faces_[local];
  return faceAtPoint_[*std::max_element(t.begin(), t.end())];
}

}  // namespace

std::optional<PatchMesh> meshPatch(const PatchSource& source, std::uint32_t patch, bool rowsAlone) {
  return PatchWork(source, patch, rowsAlone).run();
}

}  // namespace shbake
