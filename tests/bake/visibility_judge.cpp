// Visibility from a lighting point in double precision, face by face.
#include "bake/visibility_judge.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace shbake::testing {
namespace {

/// The sign of a quantity known to +-margin; 0 where that leaves it open.
int signOf(double value, double margin) {
  return value > margin ? 1 : value < -margin ? -1 : 0;
}

}  // namespace

VisibilityJudge::VisibilityJudge(const LightingPoints& points, double far) : points_(points), far_(far) {
  for (const Vec3f& p : points.positions) {
    contact_ = std::max({contact_, std::abs(double(p.x)), std::abs(double(p.y)), std::abs(double(p.z))});
  }
  contact_ *= std::numeric_limits<float>::epsilon();
}

void VisibilityJudge::setPoint(std::uint32_t point) {
  const std::uint32_t position = points_.pointPosition[point];
  origin_ = Vec3d(points_.positions[position]);
  beyond_.clear();
  for (std::uint32_t f = 0; f < points_.faces.size(); ++f) {
    const Triangle& face = points_.faces[f];
    if (std::find(face.begin(), face.end(), position) == face.end()) beyond_.push_back(f);
  }
  contacts_.clear();
  for (const std::uint32_t f : beyond_) {
    if (auto touched = touch(f)) contacts_.push_back(*std::move(touched));
  }
  collectFan(point);
  std::erase_if(contacts_, [&](const Touched& t) { return hasStart_ && covers(t, startFace_, start_); });
  height_ = highestPoint(Vec3d(points_.pointNormal[point]));
}

std::optional<VisibilityJudge::Touched> VisibilityJudge::touch(std::size_t f) const {
  const Triangle& face = points_.faces[f];
  const auto corner = [&](std::size_t k) { return Vec3d(points_.positions[face[k % 3]]) - origin_; };
  const Vec3d plane = normalized(cross(corner(1) - corner(0), corner(2) - corner(0)));
  if (plane == Vec3d() || std::abs(dot(plane, corner(0))) > contact_) return std::nullopt;
  Touched touched{{}, f, plane, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d inwards = cross(plane, normalized(corner(k + 1) - corner(k)));
    const double beyond = dot(inwards, corner(k));
    if (beyond > contact_) return std::nullopt;
    if (beyond < -contact_) continue;
    touched.inwards.push_back(inwards);
    const std::set<std::uint32_t> edge{face[k], face[(k + 1) % 3]};
    std::set<std::uint32_t> common;
    std::set_intersection(edge.begin(), edge.end(), touched.part.begin(), touched.part.end(),
                          std::inserter(common, common.end()));
    touched.part = touched.inwards.size() == 1 ? edge : common;
  }
  if (touched.inwards.empty()) touched.part = {std::uint32_t(f)};
  return touched;
}

bool VisibilityJudge::Touched::holds(const Vec3d& direction) const {
  return std::all_of(inwards.begin(), inwards.end(), [&](const Vec3d& in) { return dot(in, direction) >= 0; });
}

bool VisibilityJudge::isFlatOn(const Triangle& face, const Triangle& other) const {
  const Vec3d a(points_.positions[other[0]]), b(points_.positions[other[1]]), c(points_.positions[other[2]]);
  const Vec3d plane = normalized(cross(b - a, c - a));
  return plane != Vec3d() && std::all_of(face.begin(), face.end(), [&](std::uint32_t p) {
           return std::abs(dot(plane, Vec3d(points_.positions[p]) - a)) <= contact_;
         });
}

bool VisibilityJudge::covers(const Touched& touched, std::size_t own, const Vec3d& direction) const {
  const Triangle &a = points_.faces[touched.face], &b = points_.faces[own];
  return (isFlatOn(a, b) || isFlatOn(b, a)) && touched.holds(direction);
}

void VisibilityJudge::collectFan(std::uint32_t point) {
  const std::uint32_t position = points_.pointPosition[point];
  const Vec3d n(points_.pointNormal[point]);
  std::set<std::pair<std::uint32_t, std::uint32_t>> known;
  arcs_.clear();
  hasStart_ = false;
  double least = 2;  // cosine of the widest sector
  bool leastCovered = true;
  for (std::size_t f = 0; f < points_.faces.size(); ++f) {
    const Triangle& face = points_.faces[f];
    const auto at = static_cast<std::size_t>(std::find(face.begin(), face.end(), position) - face.begin());
    if (at == 3 || face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    const std::uint32_t i = face[(at + 1) % 3], j = face[(at + 2) % 3];
    const Vec3d a = normalized(Vec3d(points_.positions[i]) - origin_),
                b = normalized(Vec3d(points_.positions[j]) - origin_);
    const Vec3d plane = normalized(cross(a, b));
    if (known.insert(std::minmax(i, j)).second) arcs_.push_back({a, b, plane});
    const double cosine = dot(a, b);
    if (points_.facePoints[f][at] != point || plane == Vec3d()) continue;
    const Vec3d above = normalized(normalized(a + b) + plane * (dot(plane, n) < 0 ? -1e-6 : 1e-6));
    // Sectors that lie open come before those that another face covers; the widest of them is the start.
    const bool covered =
        std::any_of(contacts_.begin(), contacts_.end(), [&](const Touched& t) { return covers(t, f, above); });
    if (hasStart_ && std::tie(covered, cosine) > std::tie(leastCovered, least)) continue;
    startIsUnique_ = !hasStart_ || std::tie(covered, cosine) < std::tie(leastCovered, least);
    // Of sectors of one width, the start that is least by coordinates: a rule that no order of faces changes.
    if (!startIsUnique_ && std::tie(above.x, above.y, above.z) > std::tie(start_.x, start_.y, start_.z)) continue;
    least = cosine;
    leastCovered = covered;
    hasStart_ = true;
    start_ = above;
    startFace_ = f;
  }
}

double VisibilityJudge::highestPoint(const Vec3d& normal) const {
  double highest = 0;
  for (const Arc& arc : arcs_) {
    // The height along an arc rises to one top and falls: a golden section finds it.
    const auto height = [&](double t) { return dot(normalized(arc.a * (1 - t) + arc.b * t), normal); };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double first = low + (high - low) * 0.382, second = low + (high - low) * 0.618;
      (height(first) < height(second) ? low : high) = height(first) < height(second) ? first : second;
    }
    highest = std::max({highest, height(0), height(1), height(low)});
  }
  return highest;
}

Sees VisibilityJudge::hits(const Triangle& face, const Vec3d& d) const {
  const auto corner = [&](std::size_t k) { return Vec3d(points_.positions[face[k]]); };
  const Vec3d c = corner(0) - origin_, e1 = corner(0) - corner(1), e2 = corner(2) - corner(0);
  const Vec3d normal = cross(e2, e1), r = cross(c, d);
  if (std::abs(dot(normal, c)) <= contact_ * length(normal)) return Sees::sky;
  const double det = dot(normal, d), side = det < 0 ? -1 : 1, size = std::abs(det);
  const double u = side * dot(r, e2), v = side * dot(r, e1), w = size - u - v;
  const double uMargin = kMargin * length(c) * length(e2), vMargin = kMargin * length(c) * length(e1);
  const double detMargin = kMargin * length(e1) * length(e2);
  int least = std::min({signOf(u, uMargin), signOf(v, vMargin), signOf(w, uMargin + vMargin + detMargin)});
  const double along = side * dot(normal, c);  // the distance times |det|
  if (along <= 0) return Sees::sky;
  if (std::isfinite(far_)) {
    least = std::min(least, signOf(far_ * size - along, detMargin * (length(c) + far_)));
  }
  // Of a face seen edge-on, rounding decides whether it is met at all.
  if (least > 0 && size <= detMargin) least = 0;
  return least < 0 ? Sees::sky : least == 0 ? Sees::either : Sees::face;
}

Sees VisibilityJudge::beyondFan(const Vec3d& direction) const {
  Sees result = Sees::sky;
  for (const std::uint32_t f : beyond_) {
    const Sees one = hits(points_.faces[f], direction);
    if (one == Sees::face) return one;
    if (one == Sees::either) result = one;
  }
  return result;
}

Sees VisibilityJudge::throughFan(const Vec3d& d) const {
  // 1e-6: edges that rise less block no measurable part of the sky (1e-12 of it).
  if (!hasStart_ || height_ <= 1e-6) return Sees::sky;
  bool open = false, odd = false;
  for (const auto& [a, b, plane] : arcs_) {
    if (plane == Vec3d()) continue;
    // The arcs s-d and a-b cross where s and d lie on opposite sides of a-b, a and b on opposite sides of s-d, and the
    // crossing of the great circles on the near half of a-b is the one on the near half of s-d.
    const Vec3d great = cross(start_, d);
    const double sSide = dot(plane, start_), dSide = dot(plane, d);
    const Vec3d crossing = (start_ * dSide - d * sSide) * (dSide < sSide ? -1.0 : 1.0);
    const int apart = -signOf(dSide * (sSide < 0 ? -1 : 1), kMargin);
    const int aSide = signOf(dot(great, a), kMargin), bSide = signOf(dot(great, b), kMargin);
    const int parted = aSide == 0 || bSide == 0 ? 0 : aSide == bSide ? -1 : 1;
    const int near = dot(crossing, a + b) > 0 ? 1 : -1;
    const int least = std::min({apart, parted, near});
    if (least > 0) odd = !odd;
    if (least == 0) open = true;
  }
  return open ? Sees::either : odd ? Sees::face : Sees::sky;
}

Sees VisibilityJudge::throughContacts(const Vec3d& d) const {
  if (!hasStart_) return Sees::sky;
  struct Count {
    int crossings = 0;
    bool open = false;
  };
  std::map<std::set<std::uint32_t>, Count> counts;  // of each part of a surface
  for (const Touched& t : contacts_) {
    // The ray from a point near the origin, towards the start, meets the plane at a positive multiple of this.
    const double from = dot(t.plane, start_), to = dot(t.plane, d);
    const Vec3d met = start_ * std::abs(to) + d * std::abs(from);
    int least = -signOf(to * (from < 0 ? -1 : 1), kMargin);
    for (const Vec3d& in : t.inwards) least = std::min(least, signOf(dot(in, met), kMargin));
    Count& count = counts[t.part];
    count.crossings += least > 0;
    count.open |= least == 0;
  }
  bool open = false;
  for (const auto& [part, count] : counts) {
    if (!count.open && count.crossings % 2 == 1) return Sees::face;
    open |= count.open;
  }
  return open ? Sees::either : Sees::sky;
}

Sees VisibilityJudge::atPosition(const Vec3d& direction) const {
  const Sees fan = throughFan(direction), contact = throughContacts(direction);
  if (fan == Sees::face || contact == Sees::face) return Sees::face;
  return fan == Sees::either ? fan : contact;
}

Sees VisibilityJudge::look(const Vec3d& direction) const {
  const Sees near = atPosition(direction);
  if (near == Sees::face) return near;
  const Sees beyond = beyondFan(direction);
  return beyond == Sees::face ? beyond : near == Sees::either ? near : beyond;
}

}  // namespace shbake::testing
