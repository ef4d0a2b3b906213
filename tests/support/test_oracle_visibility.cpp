// The visibility oracle on cases whose answer is known in closed form.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "support/oracle_visibility.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

LightingPoints pointsOf(const Mesh& mesh, double creaseDegrees = 60) {
  Progress progress;
  return makeLightingPoints(mesh, {.creaseDegrees = creaseDegrees}, {}, progress);
}

// Directions spread over the sphere, different for each seed.
std::vector<Vec3d> sphereDirections(int count, std::uint64_t seed) {
  std::vector<Vec3d> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 2 * hashUnit(seed, 2 * i) - 1, phi = 2 * std::numbers::pi * hashUnit(seed, 2 * i + 1);
    const double r = std::sqrt(1 - z * z);
    directions.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  return directions;
}

// Directions with a density proportional to the cosine to +z.
std::vector<Vec3d> cosineDirections(int count, std::uint64_t seed) {
  std::vector<Vec3d> directions;
  for (int i = 0; i < count; ++i) {
    const double u = hashUnit(seed, 2 * i), phi = 2 * std::numbers::pi * hashUnit(seed, 2 * i + 1);
    directions.push_back({std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi), std::sqrt(1 - u)});
  }
  return directions;
}

}  // namespace

TEST_CASE("nothing is seen from inside a closed room, from its corners and edges either", "[oracle]") {
  for (const Mesh& room :
       {shapes::boxRoom(1), shapes::boxRoom(3), shapes::inwardSphere(1), shapes::inwardSphere(2, 0.2)}) {
    for (double crease : {60.0, 180.0}) {
      INFO(room.source << ", crease " << crease);
      const LightingPoints points = pointsOf(room, crease);
      int seen = 0;
      for (std::uint32_t q = 0; q < points.size(); ++q) {
        for (const Vec3d& d : sphereDirections(64, q)) seen += oracle::visible(points, q, d);
      }
      CHECK(seen == 0);
    }
  }
}

TEST_CASE("a convex solid hides exactly the directions below all faces at the point", "[oracle]") {
  for (const Mesh& solid : shapes::convexSolids()) {
    for (double crease : {60.0, 180.0}) {
      INFO(solid.source << ", crease " << crease);
      const LightingPoints points = pointsOf(solid, crease);
      const std::uint32_t step = points.size() > 200 ? 97 : 1;
      int wrong = 0, outside = 0, inside = 0;
      for (std::uint32_t q = 0; q < points.size(); q += step) {
        for (const Vec3d& d : sphereDirections(32, q)) {
          double highest = -1;
          for (std::uint32_t f : points.positionFaces[points.pointPosition[q]]) {
            const Triangle& t = points.faces[f];
            const Vec3d a(points.positions[t[0]]), b(points.positions[t[1]]), c(points.positions[t[2]]);
            highest = std::max(highest, dot(normalized(cross(b - a, c - a)), d));
          }
          // Directions in a face's plane are neither: rounding decides.
          if (std::abs(highest) < 1e-5) continue;
          ++(highest > 0 ? outside : inside);
          wrong += oracle::visible(points, q, d) != (highest > 0);
        }
      }
      CHECK(wrong == 0);
      CHECK(outside > 0);
      CHECK(inside > 0);
    }
  }
}

TEST_CASE("an open corner sees the octant between its squares", "[oracle]") {
  for (int n : {1, 4}) {
    for (double crease : {60.0, 180.0}) {
      const LightingPoints points = pointsOf(shapes::corner(n), crease);
      int corners = 0;
      for (std::uint32_t q = 0; q < points.size(); ++q) {
        if (!(points.positions[points.pointPosition[q]] == points.frame.toWork({0, 0, 0}))) continue;
        ++corners;
        for (const Vec3d& d : sphereDirections(500, q)) {
          if (dot(Vec3d(points.pointNormal[q]), d) <= 0) continue;
          CHECK(oracle::visible(points, q, d) == (d.x > 0 && d.y > 0 && d.z > 0));
        }
      }
      CHECK(corners == (crease < 90 ? 3 : 1));
    }
  }
}

TEST_CASE("the floor's side of a crease sees what is before the wall", "[oracle]") {
  const LightingPoints points = pointsOf(shapes::redFloorWhiteWall(4));
  int tested = 0;
  for (std::uint32_t q = 0; q < points.size(); ++q) {
    const Vec3f at = points.positions[points.pointPosition[q]];
    const bool onCrease = at == points.frame.toWork({0, 0.25, 0}) || at == points.frame.toWork({0, 0.5, 0});
    if (!onCrease) continue;
    for (const Vec3d& d : sphereDirections(500, q)) {
      if (dot(Vec3d(points.pointNormal[q]), d) <= 0) continue;
      CHECK(oracle::visible(points, q, d) == (d.x > 0 && d.z > 0));
      ++tested;
    }
  }
  CHECK(tested > 4 * 200);
}

TEST_CASE("coincident faces block like one", "[oracle]") {
  const LightingPoints points = pointsOf(shapes::doubledSheet(2));
  for (std::uint32_t q = 0; q < points.size(); ++q) {
    if (!(points.positions[points.pointPosition[q]] == points.frame.toWork({0.5, 0.5, 0}))) continue;
    for (const Vec3d& d : sphereDirections(200, q)) {
      CHECK(oracle::visible(points, q, d) == (dot(Vec3d(points.pointNormal[q]), d) > 0));
    }
  }
}

TEST_CASE("a disc above the floor hides the directions through its polygon", "[oracle]") {
  const int segments = 7;
  const double height = 2;
  const LightingPoints points = pointsOf(shapes::discAboveFloor(1, height, segments));
  const std::uint32_t floor = points.outputPoint[0];
  for (const Vec3d& d : cosineDirections(2000, 1)) {
    // The regular polygon's radius at the angle phi, from its middle to its edge at most half a segment away.
    const double half = std::numbers::pi / segments, r = std::hypot(d.x, d.y) / d.z * height;
    const double phi = std::atan2(d.y, d.x), across = std::remainder(phi - half, 2 * half);
    const double edge = std::cos(half) / std::cos(across);
    // Corners are rounded to float.
    if (std::abs(r - edge) < 1e-6) continue;
    CHECK(oracle::visible(points, floor, d) == (r > edge));
  }
}

TEST_CASE("a lid closely above an apex blocks it, however close", "[oracle]") {
  for (double gap : {1e-4, 1e-6}) {
    const LightingPoints points = pointsOf(shapes::lidAboveApex(gap));
    const std::uint32_t apex = points.outputPoint[64];
    for (const Vec3d& d : cosineDirections(200, 3)) {
      // The lid's half-side is 2.
      const bool under = std::max(std::abs(d.x), std::abs(d.y)) * gap < 2 * d.z;
      CHECK(oracle::visible(points, apex, d) == !under);
    }
  }
}

TEST_CASE("a wall hides its part of the sky", "[oracle]") {
  const double distance = 1;
  for (double height : {0.5, 2.0}) {
    const LightingPoints points = pointsOf(shapes::floorBesideWall(height, distance, 1000));
    const std::uint32_t origin = points.outputPoint[0];
    const int count = 4000;
    std::vector<oracle::WeightedDirection> directions;
    for (const Vec3d& d : cosineDirections(count, 5)) directions.push_back({d, std::numbers::pi / (count * d.z)});
    const double y00 = 0.5 / std::sqrt(std::numbers::pi);
    const double sky = oracle::shadowedTransfer(points, origin, directions, 1)[0] / y00;
    const double k = height / distance, exact = 1 - 0.5 * (1 - 1 / std::sqrt(1 + k * k));
    // A share of independent directions has the standard error sqrt(p (1-p) / N); the wall's ends, 1000 away, matter
    // 1e-6.
    CHECK(std::abs(sky - exact) < 4 * std::sqrt(exact * (1 - exact) / count));
  }
}

TEST_CASE("an open plane's transfer is the clamped cosine's projection", "[oracle]") {
  const LightingPoints points = pointsOf(shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2));
  std::vector<oracle::WeightedDirection> directions;
  // The midpoint rule in z and phi: exact in phi for these degrees, and in error by h^2/24 times the change of the
  // derivative of the integrand over 0..1 in z. In degrees 0..2 the integrands are polynomials in z of degree 3 at most
  // with |f'(1) - f'(0)| <= 2 * sqrt(5/4pi) * 6 < 8.
  const int rows = 64, columns = 16;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double z = (i + 0.5) / rows, r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * (j + 0.5) / columns;
      directions.push_back({{r * std::cos(phi), r * std::sin(phi), z}, 2 * std::numbers::pi / (rows * columns)});
    }
  }
  const double tolerance = 8.0 / 24 / (rows * rows);
  const std::vector<double> transfer = oracle::shadowedTransfer(points, points.outputPoint[4], directions, 3);
  // A_l sqrt((2l+1)/4pi) / pi for m = 0, with A = pi, 2 pi/3, pi/4 (Ramamoorthi, Hanrahan 2001); zero for m != 0.
  const double factor[3] = {1, 2.0 / 3, 1.0 / 4};
  for (int l = 0; l < 3; ++l) {
    for (int m = -l; m <= l; ++m) {
      const double exact = m == 0 ? factor[l] * std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) : 0;
      CHECK(std::abs(transfer[static_cast<std::size_t>(l * (l + 1) + m)] - exact) < tolerance);
    }
  }
}
