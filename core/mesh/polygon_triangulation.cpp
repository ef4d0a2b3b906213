// Ear clipping: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975. An ear is free when no
// reflex corner lies in it; candidates come from an array sorted by abscissa.
#include "mesh/polygon_triangulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shbake {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Corners that turn by less than this (sine) count as flat: coordinates stored as float are good to 6e-8.
constexpr double kFlatSine = 1e-6;

struct Point {
  double x, y;
  bool operator==(const Point&) const = default;
};

double cross(Point o, Point a, Point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double squaredLength(Point a, Point b) {
  return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
}

/// How the path a, b, c turns at b: +1 left, -1 right, 0 where it is flat (also straight back).
int turn(Point a, Point b, Point c) {
  const double area = cross(a, b, c);
  const double flat = kFlatSine * std::sqrt(squaredLength(a, b) * squaredLength(b, c));
  return area > flat ? 1 : area < -flat ? -1 : 0;
}

/// Twice the polygon's area vector about its first corner (M. E. Newell's method).
Vec3d newellNormal(std::span<const Vec3d> corners) {
  Vec3d sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += shbake::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return sum;
}

/// A polygon in the coordinate plane that it faces most, wound anticlockwise there.
class Projection {
 public:
  explicit Projection(std::span<const Vec3d> corners) : corners_(corners) {
    const Vec3d n = newellNormal(corners);
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    axis_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const double along = axis_ == 0 ? n.x : axis_ == 1 ? n.y : n.z;
    sign_ = along < 0 ? -1 : 1;
    flat_ = !(std::abs(along) > 0);
  }

  /// No area in any direction: all corners on one line.
  bool flat() const { return flat_; }

  /// Corner i relative to corner 0, so that coordinates far from the origin keep their digits.
  Point operator[](std::size_t i) const {
    const Vec3d p = corners_[i] - corners_[0];
    const Point q = axis_ == 0 ? Point{p.y, p.z} : axis_ == 1 ? Point{p.z, p.x} : Point{p.x, p.y};
    return {q.x, q.y * sign_};
  }

 private:
  std::span<const Vec3d> corners_;
  int axis_;
  double sign_;
  bool flat_;
};

void appendFan(std::span<const std::uint32_t> ring, Triangles& out) {
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) out.push_back({ring[0], ring[i], ring[i + 1]});
}

bool fanCovers(const Projection& polygon, std::size_t n) {
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (turn(polygon[0], polygon[i], polygon[i + 1]) <= 0) return false;
  }
  return true;
}

class EarClipper {
 public:
  EarClipper(const Projection& polygon, std::size_t n) : points_(n), next_(n), previous_(n), mayBlock_(n) {
    for (std::uint32_t i = 0; i < n; ++i) {
      points_[i] = polygon[i];
      next_[i] = i + 1 == n ? 0 : i + 1;
      previous_[i] = i == 0 ? static_cast<std::uint32_t>(n - 1) : i - 1;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      mayBlock_[i] = turnAt(i) <= 0;
      if (mayBlock_[i]) byAbscissa_.push_back(i);
    }
    std::sort(byAbscissa_.begin(), byAbscissa_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return points_[a].x < points_[b].x; });
  }

  /// Clips ears until three corners are left. Every second corner is tried first, which keeps the triangles compact.
  void clip(Triangles& out) {
    constexpr std::uint32_t kNone = ~0u;
    std::size_t left = points_.size(), tried = 0;
    std::uint32_t at = 0, flatCorner = kNone;
    while (left > 3) {
      const int side = turnAt(at);
      if (side == 0 && flatCorner == kNone) flatCorner = at;
      const bool ear = side > 0 && earIsFree(at);
      if (!ear && ++tried <= left) {
        at = next_[at];
        continue;
      }
      // Without an ear, taking off a corner of no area still leaves the rest as it is; else the outline crosses itself.
      if (!ear && flatCorner == kNone) break;
      if (!ear) at = flatCorner;
      out.push_back({previous_[at], at, next_[at]});
      at = remove(at);
      --left;
      tried = 0;
      flatCorner = kNone;
    }
    std::vector<std::uint32_t> rest(left);
    for (std::uint32_t& corner : rest) corner = std::exchange(at, next_[at]);
    appendFan(rest, out);
  }

 private:
  int turnAt(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]); }

  bool earIsFree(std::uint32_t i) const {
    const Point a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
    const auto [low, high] = std::minmax({a.x, b.x, c.x});
    auto candidate = std::lower_bound(byAbscissa_.begin(), byAbscissa_.end(), low,
                                      [&](std::uint32_t j, double x) { return points_[j].x < x; });
    for (; candidate != byAbscissa_.end() && points_[*candidate].x <= high; ++candidate) {
      const Point p = points_[*candidate];
      // A doubled corner (the bridge to a hole) lies at the ear's own corner and is no obstacle.
      if (!mayBlock_[*candidate] || p == a || p == b || p == c) continue;
      if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
    }
    return true;
  }

  /// Unlinks a corner and returns the one to try next.
  std::uint32_t remove(std::uint32_t i) {
    const std::uint32_t before = previous_[i], after = next_[i];
    next_[before] = after;
    previous_[after] = before;
    mayBlock_[i] = false;
    // Neighbours of an ear can only turn further left, so a corner that could not block never starts to.
    for (const std::uint32_t neighbour : {before, after}) {
      if (turnAt(neighbour) > 0) mayBlock_[neighbour] = false;
    }
    return next_[after];
  }

  std::vector<Point> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint8_t> mayBlock_;
  std::vector<std::uint32_t> byAbscissa_;
};

}  // namespace

void triangulatePolygon(std::span<const Vec3d> corners, Triangles& out) {
  out.clear();
  const std::size_t n = corners.size();
  if (n < 3) return;
  out.reserve(n - 2);
  const Projection polygon(corners);
  if (n == 3 || polygon.flat() || fanCovers(polygon, n)) {
    for (std::uint32_t i = 1; i + 1 < n; ++i) out.push_back({0, i, i + 1});
    return;
  }
  EarClipper(polygon, n).clip(out);
}

}  // namespace shbake
