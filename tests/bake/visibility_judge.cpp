// Visibility from a lighting point in double precision, face by face.
#include "bake/visibility_judge.h"

#include <algorithm>
#include <cmath>
#include <set>
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

Sees VisibilityJudge::hits(const Triangle& face, const Vec3d& origin, const Vec3d& d) const {
  const auto corner = [&](std::size_t k) { return Vec3d(points_.positions[face[k]]); };
  const Vec3d c = corner(0) - origin, e1 = corner(0) - corner(1), e2 = corner(2) - corner(0);
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

Sees VisibilityJudge::beyondFan(std::uint32_t point, const Vec3d& direction) const {
  const std::uint32_t position = points_.pointPosition[point];
  const Vec3d origin(points_.positions[position]);
  Sees result = Sees::sky;
  for (const Triangle& face : points_.faces) {
    if (std::find(face.begin(), face.end(), position) != face.end()) continue;
    const Sees one = hits(face, origin, direction);
    if (one == Sees::face) return one;
    if (one == Sees::either) result = one;
  }
  return result;
}

bool VisibilityJudge::startAbove(std::uint32_t point, Vec3d& start) const {
  const std::uint32_t position = points_.pointPosition[point];
  const Vec3d origin(points_.positions[position]), n(points_.pointNormal[point]);
  double widest = 0;
  for (std::size_t f = 0; f < points_.faces.size(); ++f) {
    const Triangle &face = points_.faces[f], &own = points_.facePoints[f];
    for (std::size_t k = 0; k < 3; ++k) {
      if (face[k] != position || own[k] != point) continue;
      const Vec3d a = normalized(Vec3d(points_.positions[face[(k + 1) % 3]]) - origin);
      const Vec3d b = normalized(Vec3d(points_.positions[face[(k + 2) % 3]]) - origin);
      const Vec3d up = normalized(cross(a, b));
      const double sector = std::atan2(length(cross(a, b)), dot(a, b));
      if (up == Vec3d() || sector <= widest) continue;
      widest = sector;
      start = normalized(normalized(a + b) + up * (dot(up, n) < 0 ? -1e-6 : 1e-6));
    }
  }
  return widest > 0;
}

std::vector<VisibilityJudge::Arc> VisibilityJudge::arcs(std::uint32_t point) const {
  const std::uint32_t position = points_.pointPosition[point];
  const Vec3d origin(points_.positions[position]);
  std::set<std::pair<std::uint32_t, std::uint32_t>> known;
  std::vector<Arc> result;
  for (const Triangle& face : points_.faces) {
    const auto at = std::find(face.begin(), face.end(), position) - face.begin();
    if (at == 3 || face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    const std::uint32_t i = face[static_cast<std::size_t>(at + 1) % 3], j = face[static_cast<std::size_t>(at + 2) % 3];
    if (!known.insert(std::minmax(i, j)).second) continue;
    result.push_back(
        {normalized(Vec3d(points_.positions[i]) - origin), normalized(Vec3d(points_.positions[j]) - origin)});
  }
  return result;
}

double VisibilityJudge::fanHeight(std::uint32_t point) const {
  const Vec3d n(points_.pointNormal[point]);
  double highest = 0;
  for (const Arc& arc : arcs(point)) {
    // Heights along the arc, from its ends inwards: golden sections find the top of one that has a single top.
    double low = 0, high = 1;
    const auto height = [&](double t) { return dot(normalized(arc.a * (1 - t) + arc.b * t), n); };
    for (int i = 0; i < 100; ++i) {
      const double first = low + (high - low) * 0.382, second = low + (high - low) * 0.618;
      (height(first) < height(second) ? low : high) = height(first) < height(second) ? first : second;
    }
    highest = std::max({highest, height(0), height(1), height(low)});
  }
  return highest;
}

Sees VisibilityJudge::throughFan(std::uint32_t point, const Vec3d& d) const {
  Vec3d s;
  // 1e-6: edges that rise less block no measurable part of the sky (1e-12 of it).
  if (!startAbove(point, s) || fanHeight(point) <= 1e-6) return Sees::sky;
  bool open = false, odd = false;
  for (const auto& [a, b] : arcs(point)) {
    const Vec3d plane = normalized(cross(a, b));
    if (plane == Vec3d()) continue;
    // The arcs s-d and a-b cross where s and d lie on opposite sides of a-b, a and b on opposite sides of s-d, and the
    // crossing of the great circles on the near half of a-b is the one on the near half of s-d.
    const Vec3d great = cross(s, d);
    const double sSide = dot(plane, s), dSide = dot(plane, d);
    const Vec3d crossing = (s * dSide - d * sSide) * (dSide < sSide ? -1.0 : 1.0);
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

Sees VisibilityJudge::look(std::uint32_t point, const Vec3d& direction) const {
  const Sees fan = throughFan(point, direction);
  return fan == Sees::sky ? beyondFan(point, direction) : fan;
}

}  // namespace shbake::testing
