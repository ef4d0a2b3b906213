#include "bake/fan_test.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

#include "base/wide.h"

namespace shbake {
namespace {

/// The start lies this far (radians) above its own face: far more than the rounding of double cross products of float
/// coordinates (1e-15), far less than any angle that a sampled direction resolves.
constexpr double kStartHeight = 1e-6;
/// Directions within faces in contact that differ by less than this (cosine; 1.4e-6 radians) are one.
constexpr double kSameDirection = 1 - 1e-12;
/// Edges that rise less than this above the tangent plane block no measurable part of the sky (1e-12 of it).
constexpr float kFlat = 1e-6f;
/// Above all cosines.
constexpr double kNoCosine = 2;
/// A closed fan has no more faces than this, compared at once; most have five to seven.
constexpr unsigned kRow = 8;

}  // namespace

bool FanTest::risesAboveTangentPlane(std::uint32_t p) const {
  const std::uint32_t position = points_.pointPosition[p];
  const Vec3f origin = points_.positions[position], normal = points_.pointNormal[p];
  for (const std::uint32_t f : points_.positionFaces[position]) {
    for (const std::uint32_t corner : points_.faces[f]) {
      const Vec3f edge = points_.positions[corner] - origin;
      const float height = dot(edge, normal);
      if (height > 0 && height * height > kFlat * kFlat * dot(edge, edge)) return true;
    }
  }
  return false;
}

int FanTest::edgeTo(std::uint32_t position, const Vec3f& origin) {
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].position == position) return static_cast<int>(i);
  }
  const Vec3d direction = normalized(Vec3d(points_.positions[position]) - Vec3d(origin));
  edges_.push_back({position, direction, 0, {}, 0});
  return static_cast<int>(edges_.size()) - 1;
}

int FanTest::edgeAlong(const Vec3d& direction, std::size_t firstEdge) {
  for (std::size_t i = firstEdge; i < edges_.size(); ++i) {
    if (dot(edges_[i].direction, direction) > kSameDirection) return static_cast<int>(i);
  }
  edges_.push_back({kNone, direction, 0, {}, 0});
  return static_cast<int>(edges_.size()) - 1;
}

bool FanTest::isOwn(std::uint32_t face, std::uint32_t p) const {
  if (face == kNone) return false;
  if (ownContact_ != nullptr) return face == ownContact_->face;
  const Triangle& own = points_.facePoints[face];
  return own[0] == p || own[1] == p || own[2] == p;
}

const Contact* FanTest::findOwnContact(std::uint32_t p) const {
  const std::uint32_t position = points_.pointPosition[p];
  if (!points_.positionFaces[position].empty()) return nullptr;
  // Of all faces that the position lies on, the point is on the front of the one that looks its normal's way.
  const Vec3d normal(points_.pointNormal[p]);
  const Contact* own = nullptr;
  double most = 0;
  for (const Contact& contact : contacts_.of(position)) {
    const double along = dot(sectorsOf(points_, contact).normal, normal);
    if (own != nullptr && along <= most) continue;
    own = &contact;
    most = along;
  }
  return own;
}

void FanTest::addArc(std::uint32_t face, int from, int to, std::uint32_t p, std::size_t firstArc) {
  // Coincident faces are one wall, not two that cancel. The point's own face stands for those wound like it.
  const auto known =
      std::find_if(arcs_.begin() + static_cast<std::ptrdiff_t>(firstArc), arcs_.end(),
                   [&](const Arc& a) { return (a.from == from && a.to == to) || (a.from == to && a.to == from); });
  if (known != arcs_.end()) {
    std::uint32_t& side = known->from == from ? known->face : known->back;
    if (side == kNone || isOwn(face, p)) side = face;
    return;
  }
  arcs_.push_back({face, kNone, from, to, 0, {}, false, true, true});
  ++edges_[static_cast<std::size_t>(from)].uses;
  ++edges_[static_cast<std::size_t>(to)].uses;
}

// Nearly every position lies amid rings of faces, in which each edge ends one face and begins another: edges and faces
// are then as many, and need not be searched one by one. False: it is not so, and nothing was added.
bool FanTest::addClosedFan(std::uint32_t p) {
  const std::uint32_t position = points_.pointPosition[p];
  const std::span<const std::uint32_t> faces = points_.positionFaces[position];
  const std::size_t count = faces.size();
  if (count > kRow) return false;
  // Edge k leads to the corner that follows the position in face k.
  std::array<std::uint32_t, kRow> starts, ends;
  starts.fill(kNone);
  for (std::size_t k = 0; k < count; ++k) {
    const Triangle& t = points_.faces[faces[k]];
    const std::size_t corner = t[0] == position ? 0 : t[1] == position ? 1 : 2;
    starts[k] = t[(corner + 1) % 3];
    ends[k] = t[(corner + 2) % 3];
  }
  std::array<unsigned, kRow> next;
  unsigned reached = 0;
  for (std::size_t k = 0; k < count; ++k) {
    unsigned same = 0;
    for (unsigned i = 0; i < kRow; ++i) same |= starts[i] == ends[k] ? 1u << i : 0;
    if (same == 0 || (same & (same - 1)) != 0) return false;
    next[k] = static_cast<unsigned>(std::countr_zero(same));
    reached |= same;
  }
  if (reached != (1u << count) - 1) return false;
  for (std::size_t k = 0; k < count; ++k) {
    if (next[next[k]] == k) return false;  // two coincident faces, or one without extent
  }
  const Vec3d origin(points_.positions[position]);
  for (std::size_t k = 0; k < count; ++k) {
    edges_.push_back({kNone, normalized(Vec3d(points_.positions[starts[k]]) - origin), 0, {}, 2});
    arcs_.push_back({faces[k], kNone, static_cast<int>(k), static_cast<int>(next[k]), 0, {}, false, true, true});
  }
  return true;
}

void FanTest::addFan(std::uint32_t p) {
  edges_.clear();
  arcs_.clear();
  if (addClosedFan(p)) return;
  const std::uint32_t position = points_.pointPosition[p];
  const Vec3f origin = points_.positions[position];
  for (const std::uint32_t f : points_.positionFaces[position]) {
    const Triangle& t = points_.faces[f];
    const std::size_t corner = t[0] == position ? 0 : t[1] == position ? 1 : 2;
    const int from = edgeTo(t[(corner + 1) % 3], origin), to = edgeTo(t[(corner + 2) % 3], origin);
    addArc(f, from, to, p, 0);
  }
}

void FanTest::addOwnSectors(std::uint32_t p) {
  ownContact_ = findOwnContact(p);
  if (ownContact_ == nullptr) return;
  for (const Contact& contact : contacts_.of(points_.pointPosition[p])) {
    if (contact.isSamePart(*ownContact_)) addSectors(contact, p, 0, 0);
  }
}

void FanTest::addSectors(const Contact& contact, std::uint32_t p, std::size_t firstEdge, std::size_t firstArc) {
  const ContactSectors sectors = sectorsOf(points_, contact);
  for (std::size_t k = 0; k + 1 < sectors.count; ++k) {
    const int from = edgeAlong(sectors.direction[k], firstEdge), to = edgeAlong(sectors.direction[k + 1], firstEdge);
    addArc(contact.face, from, to, p, firstArc);
  }
}

void FanTest::addContacts(std::uint32_t p, std::uint32_t startFace, const Vec3d& start) {
  const std::span<const Contact> contacts = contacts_.of(points_.pointPosition[p]);
  for (std::size_t i = 0, end = 0; i < contacts.size(); i = end) {
    const std::size_t firstEdge = edges_.size(), firstArc = arcs_.size();
    for (end = i; end < contacts.size() && contacts[end].isSamePart(contacts[i]); ++end) {
      const bool inFan = ownContact_ != nullptr && contacts[end].isSamePart(*ownContact_);
      // A face that the start lies in is one wall with the start's own: it has no side of its own.
      if (inFan || isCovered(startFace, start, contacts[end])) continue;
      addSectors(contacts[end], p, firstEdge, firstArc);
    }
    if (arcs_.size() > firstArc) surfaceEnds_.push_back(arcs_.size());
  }
}

bool FanTest::isCovered(std::uint32_t face, const Vec3d& direction, const Contact& by) const {
  return areCoplanar(points_, face, by.face, contacts_.distance()) && sectorsOf(points_, by).hold(direction);
}

double FanTest::findOwn(std::uint32_t p) {
  double widest = kNoCosine;
  for (Arc& arc : arcs_) {
    arc.own = isOwn(arc.face, p) || isOwn(arc.back, p);
    arc.cosine = dot(directionOf(arc.from), directionOf(arc.to));
    if (arc.own) widest = std::min(widest, arc.cosine);
  }
  return widest;
}

const FanTest::Arc* FanTest::chooseStart(std::uint32_t p, const Vec3d& normal, Vec3d& start) {
  const double widest = findOwn(p);
  const std::span<const Contact> contacts = contacts_.of(points_.pointPosition[p]);
  const Arc* best = nullptr;
  double least = kNoCosine;  // cosine of the widest sector so far
  bool bestCovered = false;
  const auto consider = [&](const Arc& arc) {
    const Vec3d a = directionOf(arc.from), b = directionOf(arc.to);
    const Vec3d n = normalized(cross(a, b));
    if (n == Vec3d{}) return;
    const Vec3d above = normalized(normalized(a + b) + n * (dot(n, normal) < 0 ? -kStartHeight : kStartHeight));
    // What another face covers, such as the ground within the foot of a wall, is not the side that is looked at.
    const bool covered =
        std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) { return isCovered(arc.face, above, c); });
    // Sectors of one width are common (the two halves of a square's corner): not the order of faces decides.
    const auto rank = [](bool isHidden, double c, const Vec3d& s) { return std::tuple(isHidden, c, s.x, s.y, s.z); };
    if (best != nullptr && rank(covered, arc.cosine, above) >= rank(bestCovered, least, start)) return;
    best = &arc;
    bestCovered = covered;
    least = arc.cosine;
    start = above;
  };
  const auto considerAll = [&](double most) {
    for (const Arc& arc : arcs_) {
      if (arc.own && arc.cosine <= most) consider(arc);
    }
  };
  // Where nothing covers any, the widest counts, unless it has no extent.
  if (contacts.empty()) considerAll(widest);
  if (best == nullptr) considerAll(kNoCosine);
  return best;
}

void FanTest::orient(const Vec3d& start) {
  for (Edge& e : edges_) e.plane = Vec3f(cross(start, e.direction));
  for (Arc& arc : arcs_) {
    Vec3d plane = cross(directionOf(arc.from), directionOf(arc.to));
    arc.front = dot(plane, start) > 0;  // faces are wound so that from, to turn about their front normal
    if (!arc.front) {
      std::swap(arc.from, arc.to);
      plane = -plane;
      if (arc.back != kNone) {
        std::swap(arc.face, arc.back);
        arc.front = true;
      }
    }
    arc.plane = Vec3f(plane);
  }
}

float FanTest::findHighest(const Vec3d& start, const Vec3d& normal) {
  // The top of a minor arc is one of its ends, or the top of its great circle where the arc rises from both.
  const auto topOf = [&](const Vec3d& a, double heightA, const Vec3d& b, double heightB) {
    const double ends = std::max(heightA, heightB), cosine = dot(a, b);
    if (heightB <= heightA * cosine || heightA <= heightB * cosine) return ends;
    const Vec3d c = cross(a, b);
    const double cc = dot(c, c);
    return cc > 0 ? std::max(ends, length(normal - c * (dot(c, normal) / cc))) : ends;
  };
  for (Edge& e : edges_) e.height = dot(e.direction, normal);
  double highest = 0;
  for (Arc& arc : arcs_) {
    const Edge &from = edges_[static_cast<std::size_t>(arc.from)], &to = edges_[static_cast<std::size_t>(arc.to)];
    const double top = topOf(from.direction, from.height, to.direction, to.height);
    arc.rises = top > static_cast<double>(kFlat);
    highest = std::max(highest, top);
  }
  if (highest <= static_cast<double>(kFlat)) return 0;
  // Where the fan is open, crossings also change across the arc from its border to the point opposite the start.
  const Vec3d opposite = -start;
  const double depth = dot(opposite, normal);
  for (const Edge& e : edges_) {
    if (e.uses % 2 != 0) highest = std::max(highest, topOf(e.direction, e.height, opposite, depth));
  }
  return static_cast<float>(highest) + kFlat;
}

void FanTest::keepRisingArcs() {
  std::size_t kept = 0, k = 0;
  for (std::size_t& end : surfaceEnds_) {
    for (; k < end; ++k) {
      if (!arcs_[k].rises) continue;
      if (kept != k) arcs_[kept] = arcs_[k];
      ++kept;
    }
    end = kept;
  }
  arcs_.resize(kept);
}

void FanTest::setPoint(std::uint32_t p) {
  height_ = 0;
  zenithBlocked_ = false;
  ownContact_ = nullptr;
  if (!risesAboveTangentPlane(p) && contacts_.of(points_.pointPosition[p]).empty()) return;
  addFan(p);
  addOwnSectors(p);
  surfaceEnds_.assign(1, arcs_.size());
  const Vec3d normal(points_.pointNormal[p]);
  Vec3d start;
  const Arc* own = chooseStart(p, normal, start);
  if (own == nullptr) return;
  addContacts(p, own->face, start);
  height_ = findHighest(start, normal);
  if (height_ == 0) return;
  // From a start above the tangent plane to a direction above it, no arc that stays below is crossed.
  if (dot(start, normal) >= 0) keepRisingArcs();
  orient(start);
  zenithBlocked_ = isBlocked(points_.pointNormal[p]);
}

bool FanTest::isCrossed(const Arc& arc, const Vec3f& d) const {
  const Edge &from = edges_[static_cast<std::size_t>(arc.from)], &to = edges_[static_cast<std::size_t>(arc.to)];
  return dot(from.plane, d) >= 0 && !(dot(to.plane, d) >= 0) && dot(arc.plane, d) < 0;
}

bool FanTest::isBlocked(const Vec3f& direction) const {
  std::size_t first = 0;
  for (const std::size_t end : surfaceEnds_) {
    const auto crossed = std::count_if(arcs_.begin() + static_cast<std::ptrdiff_t>(first),
                                       arcs_.begin() + static_cast<std::ptrdiff_t>(end),
                                       [&](const Arc& arc) { return isCrossed(arc, direction); });
    if (crossed % 2 != 0) return true;
    first = end;
  }
  return false;
}

SHBAKE_WIDE std::uint32_t FanTest::crossedOddly(std::size_t firstArc, std::size_t endArc, const float* x,
                                                const float* y, const float* z, std::uint32_t* faces) const {
  std::array<std::int32_t, 16> odd{};
  std::array<std::uint32_t, 16> last{};
  for (std::size_t k = firstArc; k < endArc; ++k) {
    const Arc& arc = arcs_[k];
    const Vec3f a = edges_[static_cast<std::size_t>(arc.from)].plane,
                b = edges_[static_cast<std::size_t>(arc.to)].plane;
    const Vec3f c = arc.plane;
    std::array<std::int32_t, 16> crossed;
    for (std::size_t i = 0; i < 16; ++i) {
      // A shared edge is judged by the same numbers for both of its faces: no direction slips between them.
      const bool pastFrom = a.x * x[i] + a.y * y[i] + a.z * z[i] >= 0;
      const bool pastTo = b.x * x[i] + b.y * y[i] + b.z * z[i] >= 0;
      const bool behind = c.x * x[i] + c.y * y[i] + c.z * z[i] < 0;
      crossed[i] = static_cast<std::int32_t>(pastFrom & !pastTo & behind);
    }
    for (std::size_t i = 0; i < 16; ++i) odd[i] ^= crossed[i];
    if (faces == nullptr) continue;
    for (std::size_t i = 0; i < 16; ++i) last[i] = crossed[i] != 0 ? arc.face : last[i];
  }
  std::uint32_t mask = 0;
  for (unsigned i = 0; i < 16; ++i) mask |= static_cast<std::uint32_t>(odd[i]) << i;
  if (faces == nullptr) return mask;
  for (std::size_t i = 0; i < 16; ++i) faces[i] = odd[i] != 0 ? last[i] : faces[i];
  return mask;
}

std::uint32_t FanTest::blocked(const float* x, const float* y, const float* z, std::uint32_t* faces) const {
  std::uint32_t mask = 0;
  std::size_t first = 0;
  for (const std::size_t end : surfaceEnds_) {
    mask |= crossedOddly(first, end, x, y, z, faces);
    first = end;
  }
  return mask;
}

bool FanTest::facesFront(std::uint32_t face) const {
  const auto arc = std::find_if(arcs_.begin(), arcs_.end(), [&](const Arc& a) { return a.face == face; });
  return arc != arcs_.end() && arc->front;
}

}  // namespace shbake
