// The plane below a mesh: where it lies, how it is divided, which way it faces.
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "view/ground_plane.h"

using namespace shbake;

namespace {

/// The corners of a box with z up, turned into the axes of `up`.
std::vector<Vec3d> box(const Vec3d& low, const Vec3d& high, UpAxis up) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(axesFor(up) * Vec3d{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  return corners;
}

}  // namespace

TEST_CASE("the ground lies just below the lowest point, faces up and covers a square without a gap") {
  for (const UpAxis up : {UpAxis::z, UpAxis::y}) {
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const Vec3d low = Vec3d{3, -2, 5} * scale, high = Vec3d{5, -1, 7} * scale;  // diagonal 3
      const Mesh plane = groundPlane(box(low, high, up), up);
      const sh::Matrix3d back = sh::transposed(axesFor(up));
      double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
      for (const Vec3d& p : plane.positions) {
        const Vec3d q = back * p;
        REQUIRE(q.z == Approx((5 - 3 * kGroundGap) * scale));
        west = std::min(west, q.x);
        east = std::max(east, q.x);
        south = std::min(south, q.y);
        north = std::max(north, q.y);
      }
      CHECK(west < (3 - 3 * kGroundReach) * scale);
      CHECK(east > (5 + 3 * kGroundReach) * scale);
      CHECK((south < (-2 - 3 * kGroundReach) * scale && north > (-1 + 3 * kGroundReach) * scale));
      double area = 0;
      for (const Triangle& t : plane.triangles) {
        const Vec3d &a = plane.positions[t[0]], &b = plane.positions[t[1]], &c = plane.positions[t[2]];
        const Vec3d normal = back * cross(b - a, c - a);
        REQUIRE(normal.z > 0);
        area += normal.z / 2;
      }
      CHECK(area == Approx((east - west) * (north - south)));
      REQUIRE(plane.vertexNormals.size() == plane.positions.size());
      for (const Vec3f& n : plane.vertexNormals) REQUIRE(Vec3d(n) == axesFor(up) * Vec3d{0, 0, 1});
    }
  }
}

TEST_CASE("below the mesh the ground is finely divided, and flat or thin meshes have one too") {
  for (const Vec3d& size : {Vec3d{1, 1, 1}, Vec3d{4, 1, 0}, Vec3d{0, 0, 2}, Vec3d{0.1, 0.2, 5}}) {
    const Mesh plane = groundPlane(box({0, 0, 0}, size, UpAxis::z), UpAxis::z);
    const double most = std::max({size.x, size.y, size.z / 2});
    for (const Triangle& t : plane.triangles) {
      const Vec3d &a = plane.positions[t[0]], &b = plane.positions[t[1]], &c = plane.positions[t[2]];
      const bool below = std::min({a.x, b.x, c.x}) >= 0 && std::max({a.x, b.x, c.x}) <= size.x &&
                         std::min({a.y, b.y, c.y}) >= 0 && std::max({a.y, b.y, c.y}) <= size.y;
      if (below) REQUIRE(length(cross(b - a, c - a)) <= most * most / 4096 * (1 + 1e-9));
    }
    CHECK(plane.positions.size() < 150000);
  }
  CHECK_THROWS_AS(groundPlane({}, UpAxis::z), Error);
  CHECK_THROWS_AS(groundPlane(std::vector<Vec3d>(3, Vec3d{1, 2, 3}), UpAxis::z), Error);
  CHECK_THROWS_AS(groundPlane(std::vector<Vec3d>{{0, 0, 0}, {1, NAN, 0}}, UpAxis::z), Error);
}
