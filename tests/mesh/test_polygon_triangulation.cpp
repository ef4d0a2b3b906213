// Triangulation covers a polygon exactly: signed areas are all positive and sum to the polygon's own.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "mesh/polygon_triangulation.h"

using namespace shbake;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Outline = std::vector<Vec3d>;

Vec3d areaVector(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return cross(b - a, c - a) * 0.5;
}

/// Area of a planar polygon along a unit normal, about its first corner.
double polygonArea(const Outline& p, const Vec3d& normal) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += dot(areaVector(p[0], p[i], p[i + 1]), normal);
  return sum;
}

/// Checks that n - 2 triangles wound like the polygon add up to its area: with no negative one, they neither overlap
/// nor leave the outline.
void checkCovered(const Outline& p, const Vec3d& normal) {
  Triangles triangles;
  triangulatePolygon(p, triangles);
  REQUIRE(triangles.size() == p.size() - 2);
  const double area = polygonArea(p, normal);
  REQUIRE(area > 0);
  double sum = 0;
  for (const auto& t : triangles) {
    const double a = dot(areaVector(p[t[0]], p[t[1]], p[t[2]]), normal);
    CHECK(a >= -1e-12 * area);
    sum += a;
  }
  CHECK(sum == Approx(area).epsilon(1e-11));
}

/// The plane polygon (x, y) placed in a tilted, shifted and scaled plane, with that plane's normal.
struct Placed {
  Outline outline;
  Vec3d normal;
};
Placed place(const std::vector<std::pair<double, double>>& flat, double scale, const Vec3d& shift) {
  const Vec3d n = normalized(Vec3d(1, -2, 0.5)), u = normalized(cross(n, Vec3d(0, 0, 1))), v = cross(n, u);
  Placed placed{{}, n};
  for (const auto& [x, y] : flat) placed.outline.push_back((u * x + v * y) * scale + shift);
  return placed;
}

const std::vector<std::pair<double, double>> kLetterL = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
const std::vector<std::pair<double, double>> kDart = {{0, 0}, {2, -1}, {0.5, 0}, {2, 1}};
const std::vector<std::pair<double, double>> kComb = {{0, 0}, {7, 0}, {7, 5}, {6, 5}, {6, 1}, {5, 1}, {5, 5}, {4, 5},
                                                      {4, 1}, {3, 1}, {3, 5}, {2, 5}, {2, 1}, {1, 1}, {1, 5}, {0, 5}};
// A square ring: the hole is reached over the doubled edge (0,0)-(1,1).
const std::vector<std::pair<double, double>> kKeyhole = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0},
                                                         {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
// Corners in the middle of straight edges.
const std::vector<std::pair<double, double>> kFlatCorners = {{0, 0}, {1, 0}, {2, 0}, {2, 1},
                                                             {2, 2}, {1, 2}, {0, 2}, {0, 1}};

}  // namespace

TEST_CASE("a convex polygon becomes the plain fan") {
  Triangles t;
  triangulatePolygon(Outline{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, t);
  CHECK(t == Triangles{{0, 1, 2}, {0, 2, 3}});
  triangulatePolygon(Outline{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, t);
  CHECK(t == Triangles{{0, 1, 2}, {0, 2, 3}});
  triangulatePolygon(Outline{{5, 0, 0}, {0, 5, 0}, {0, 0, 5}}, t);
  CHECK(t == Triangles{{0, 1, 2}});
}

TEST_CASE("fewer than three corners give no triangle") {
  Triangles t{{7, 7, 7}};
  triangulatePolygon(Outline{{0, 0, 0}, {1, 0, 0}}, t);
  CHECK(t.empty());
}

TEST_CASE("concave outlines are covered in any plane, size, place, winding and starting corner") {
  for (auto flat : {kLetterL, kDart, kComb, kKeyhole, kFlatCorners}) {
    for (std::size_t start = 0; start < flat.size(); ++start) {
      std::rotate(flat.begin(), flat.begin() + 1, flat.end());
      for (const double scale : {1.0, 1e-6, 1e6}) {
        auto [outline, normal] = place(flat, scale, {});
        checkCovered(outline, normal);
        std::reverse(outline.begin(), outline.end());
        checkCovered(outline, -normal);
      }
    }
  }
}

TEST_CASE("a polygon far from the origin is cut like one at the origin") {
  Outline far;
  for (const auto& [x, y] : kComb) far.push_back({x + 4'500'000, y - 5'400'000, 300});
  checkCovered(far, {0, 0, 1});
}

TEST_CASE("every coordinate plane is projected the right way round") {
  for (int axis = 0; axis < 3; ++axis) {
    Outline p;
    for (const auto& [x, y] : kLetterL) {
      p.push_back(axis == 0 ? Vec3d(0, x, y) : axis == 1 ? Vec3d(y, 0, x) : Vec3d(x, y, 0));
    }
    checkCovered(p, axis == 0 ? Vec3d(1, 0, 0) : axis == 1 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1));
  }
}

TEST_CASE("random star-shaped outlines of many corners are covered") {
  for (const std::size_t n : {5, 17, 256, 20000}) {
    std::vector<std::pair<double, double>> flat;
    for (std::size_t i = 0; i < n; ++i) {
      const double radius = 0.2 + hashUnit(n, i), angle = 2 * std::numbers::pi * static_cast<double>(i) / double(n);
      flat.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const auto [outline, normal] = place(flat, 1, {1, 2, 3});
    Triangles triangles;
    triangulatePolygon(outline, triangles);
    REQUIRE(triangles.size() == n - 2);
    double sum = 0;
    for (const auto& t : triangles) {
      sum += std::abs(dot(areaVector(outline[t[0]], outline[t[1]], outline[t[2]]), normal));
    }
    CHECK(sum == Approx(polygonArea(outline, normal)).epsilon(1e-9));
  }
}

TEST_CASE("a saddle quad is cut without folding over") {
  checkCovered({{0, 0, 0}, {1, 0, 0.3}, {1, 1, 0}, {0, 1, 0.3}}, {0, 0, 1});
}

TEST_CASE("outlines without area or crossing themselves still give n - 2 valid triangles") {
  const Vec3d nan(std::nan(""), 0, 0);
  const std::vector<Outline> outlines = {
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 0, 0}},          // on one line
      {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},                     // one point
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                     // bow-tie with no net area
      {{0, 0, 0}, {4, 3, 0}, {4, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}},       // crosses itself
      {{0, 1, 0}, {-1, -1, 0}, {1, 0.5, 0}, {-1, 0.5, 0}, {1, -1, 0}},  // pentagram
      {{0, 0, 0}, {1, 0, 0}, nan, {0, 1, 0}, {0, 0.5, 0}},
  };
  for (const Outline& outline : outlines) {
    Triangles triangles;
    triangulatePolygon(outline, triangles);
    REQUIRE(triangles.size() == outline.size() - 2);
    for (const auto& t : triangles) {
      for (const std::uint32_t corner : t) CHECK(corner < outline.size());
      CHECK((t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
    }
  }
}
