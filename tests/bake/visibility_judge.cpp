// Visibility from a lighting point in double precision, face by face.
#include "bake/visibility_judge.h"

#include <algorithm>
#include <cmath>
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
  collectFan(point);
  height_ = highestPoint(Vec3d(points_.pointNormal[point]));
}

void VisibilityJudge::collectFan(std::uint32_t point) {
  const std::uint32_t position = points_.pointPosition[point];
  const Vec3d n(points_.pointNormal[point]);
  std::set<std::pair<std::uint32_t, std::uint32_t>> known;
  arcs_.clear();
  hasStart_ = false;
  double least = 2;  // cosine of the widest sector
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
    if (points_.facePoints[f][at] != point || plane == Vec3d() || cosine > least) continue;
    const Vec3d above = normalized(normalized(a + b) + plane * (dot(plane, n) < 0 ? -1e-6 : 1e-6));
    startIsUnique_ = cosine < least;
    // Of sectors of one width, the start that is least by coordinates: a rule that no order of faces changes.
    if (!startIsUnique_ && std::tie(above.x, above.y, above.z) > std::tie(start_.x, start_.y, start_.z)) continue;
    least = cosine;
    hasStart_ = true;
    start_ = above;
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

Sees VisibilityJudge::look(const Vec3d& direction) const {
  const Sees fan = throughFan(direction);
  return fan == Sees::sky ? beyondFan(direction) : fan;
}

}  // namespace shbake::testing
