// The slow, obviously right twin of the traced visibility.
#include "support/oracle_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "sh/basis.h"

namespace shbake::oracle {
namespace {

using Real = long double;
using Vec = Vec3<Real>;

Real determinant(Vec a, Vec b, Vec c) {
  return dot(cross(a, b), c);
}

bool touches(const Triangle& face, std::uint32_t position) {
  return std::find(face.begin(), face.end(), position) != face.end();
}

// Whether a ray from the origin along d meets the triangle a, b, c beyond `nearest`. The signed volumes tell on which
// side of each edge the ray passes; an edge itself counts as part of the triangle.
bool hits(Vec d, Vec a, Vec b, Vec c, Real nearest) {
  const Real u = determinant(d, a, b), v = determinant(d, b, c), w = determinant(d, c, a);
  const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  if (!inside) return false;
  const Vec normal = cross(b - a, c - a);
  const Real slope = dot(normal, d);
  return slope != 0 && dot(normal, a) / slope > nearest;
}

// A face that touches the position, seen from there.
struct FanFace {
  std::uint32_t face;
  std::array<std::uint32_t, 2> neighbours;  // the positions of its other corners
};

class Fan {
 public:
  Fan(const LightingPoints& points, std::uint32_t point) : points_(points), point_(point) {
    const std::uint32_t here = points.pointPosition[point];
    for (std::uint32_t f = 0; f < points.faces.size(); ++f) {
      const Triangle& t = points.faces[f];
      if (std::count(t.begin(), t.end(), here) != 1 || t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      const std::size_t k = static_cast<std::size_t>(std::find(t.begin(), t.end(), here) - t.begin());
      faces_.push_back({f, {t[(k + 1) % 3], t[(k + 2) % 3]}});
    }
  }

  /// Just above the widest of the point's own faces, on the side of its normal.
  std::optional<Vec> start() const {
    std::optional<Vec> best;
    Real widest = 0;
    for (const FanFace& f : faces_) {
      const Triangle& own = points_.facePoints[f.face];
      if (std::find(own.begin(), own.end(), point_) == own.end()) continue;
      const Vec a = normalized(towards(f.neighbours[0])), b = normalized(towards(f.neighbours[1]));
      const Vec normal = normalized(cross(a, b));
      const Real angle = angleBetween(a, b);
      if (normal == Vec() || angle <= widest) continue;
      widest = angle;
      const Real side = dot(normal, Vec(points_.pointNormal[point_])) < 0 ? -1 : 1;
      best = normalized(normalized(a + b) + normal * (side * 1e-6L));
    }
    return best;
  }

  bool blocks(Vec d) const {
    const std::optional<Vec> from = start();
    if (!from) return false;
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    int crossings = 0;
    for (const FanFace& f : faces_) {
      const auto [low, high] = std::minmax(f.neighbours[0], f.neighbours[1]);
      if (seen.insert({low, high}).second) crossings += crosses(*from, d, towards(low), towards(high));
    }
    return crossings % 2 == 1;
  }

 private:
  Vec towards(std::uint32_t position) const {
    return Vec(points_.positions[position]) - Vec(points_.positions[points_.pointPosition[point_]]);
  }

  // Whether the arcs s-d and a-b cross. An end that lies on the other arc's plane counts as on its positive side, for
  // every face that shares this end, so that a path through an edge crosses two faces or none.
  static bool crosses(Vec s, Vec d, Vec a, Vec b) {
    const Vec plane = cross(s, d);
    const Real sideA = dot(plane, a), sideB = dot(plane, b);
    if ((sideA >= 0) == (sideB >= 0)) return false;
    // The point where a-b passes through the plane, as a sum of positive parts of a and b.
    const Vec x = a * std::abs(sideB) + b * std::abs(sideA);
    return dot(cross(s, x), plane) > 0 && dot(cross(x, d), plane) > 0;
  }

  const LightingPoints& points_;
  std::uint32_t point_;
  std::vector<FanFace> faces_;
};

}  // namespace

bool blockedByFan(const LightingPoints& points, std::uint32_t point, const Vec3d& direction) {
  return Fan(points, point).blocks(Vec(direction));
}

bool visible(const LightingPoints& points, std::uint32_t point, const Vec3d& direction, double nearest) {
  const std::uint32_t here = points.pointPosition[point];
  const Vec origin(points.positions[here]), d = normalized(Vec(direction));
  for (const Triangle& t : points.faces) {
    if (touches(t, here)) continue;
    const auto corner = [&](std::size_t k) { return Vec(points.positions[t[k]]) - origin; };
    if (hits(d, corner(0), corner(1), corner(2), nearest)) return false;
  }
  return !Fan(points, point).blocks(d);
}

std::vector<double> shadowedTransfer(const LightingPoints& points, std::uint32_t point,
                                     std::span<const WeightedDirection> directions, int order, double nearest) {
  const Vec3d normal(points.pointNormal[point]);
  std::vector<double> transfer(static_cast<std::size_t>(order * order)), basis(transfer.size());
  for (const WeightedDirection& item : directions) {
    const double cosine = dot(normal, item.direction);
    if (cosine <= 0 || !visible(points, point, item.direction, nearest)) continue;
    sh::oracle::evaluateByRecurrence(order, item.direction, basis);
    const double weight = item.solidAngle * cosine / std::numbers::pi;
    for (std::size_t i = 0; i < transfer.size(); ++i) transfer[i] += weight * basis[i];
  }
  return transfer;
}

}  // namespace shbake::oracle
