// What is one convex solid: bodies of all kinds, however turned and rounded; and what comes near but is none.
#include <catch2/catch.hpp>

#include "mesh/convex_hull.h"
#include "mesh/convexity.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

bool isConvex(const Mesh& mesh, const LightingPointOptions& options = {}) {
  Progress progress;
  return isConvexSolid(makeLightingPoints(mesh, options, Albedo{}, progress), progress);
}

/// A unit cube with a vertex in the middle of its top, at `height` above it.
Mesh cubeWithPeak(double height) {
  Mesh mesh = shapes::cube();
  Vec3d low = mesh.positions[0], high = low;
  for (const Vec3d& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  std::vector<Triangle> faces;
  const auto peak = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<std::array<std::uint32_t, 2>> rim;
  for (const Triangle& t : mesh.triangles) {
    const bool top = std::all_of(t.begin(), t.end(), [&](auto v) { return mesh.positions[v].z == high.z; });
    if (!top) {
      faces.push_back(t);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d &a = mesh.positions[t[k]], &b = mesh.positions[t[(k + 1) % 3]];
      if (a.x == b.x || a.y == b.y) faces.push_back({t[k], t[(k + 1) % 3], peak});
    }
  }
  mesh.positions.push_back({(low.x + high.x) / 2, (low.y + high.y) / 2, high.z + height});
  mesh.triangles = faces;
  return mesh;
}

}  // namespace

TEST_CASE("convex solids are convex, however they are turned and shifted", "[convexity]") {
  for (const Mesh& solid : shapes::convexSolids()) {
    INFO(solid.source);
    CHECK(isConvex(solid));
    for (int i = 1; i < 8; ++i) {
      const Mesh turned = shapes::rotated(solid, shapes::rotationAbout({1, 2, double(i)}, 0.37 * i));
      CHECK(isConvex(turned));
      CHECK(isConvex(shapes::translated(turned, {1000.0 * i, -300, 7})));
    }
  }
}

TEST_CASE("a dent, a hole, a second solid or the wrong side out make a solid not convex", "[convexity]") {
  const Mesh cube = shapes::cube();
  CHECK(isConvex(cube));
  CHECK(isConvex(cubeWithPeak(0.1)));
  CHECK(isConvex(cubeWithPeak(0)));
  CHECK_FALSE(isConvex(cubeWithPeak(-0.001)));
  CHECK_FALSE(isConvex(cubeWithPeak(-0.4)));
  Mesh open = cube;
  open.triangles.pop_back();
  CHECK_FALSE(isConvex(open));
  CHECK_FALSE(isConvex(shapes::flipped(cube)));
  CHECK_FALSE(isConvex(shapes::merged(cube, shapes::translated(cube, {5, 0, 0}))));
  // One within the other: no edge bends inwards, but the volume is that of both.
  CHECK_FALSE(isConvex(shapes::merged(cube, shapes::flipped(shapes::scaled(cube, 0.5)))));
  CHECK_FALSE(isConvex(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 2, 2)));
}

TEST_CASE("a normal that leans out of its faces' reach makes a solid not convex", "[convexity]") {
  Mesh cube = shapes::cube();
  cube.cornerNormals.clear();
  cube.vertexNormals.clear();
  LightingPointOptions flat;
  flat.normals = NormalSource::flat;
  CHECK(isConvex(cube, flat));
  // All normals upwards: at the top that is right, at the sides the faces above rise over the plane.
  cube.vertexNormals.assign(cube.positions.size(), Vec3f(0, 0, 1));
  CHECK_FALSE(isConvex(cube));
}

TEST_CASE("the volume of hulls", "[convexity]") {
  CHECK(convexHullVolume({}) == 0);
  std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  CHECK(convexHullVolume(points) == 0);
  points.push_back({0.5f, 0.5f, 3});
  CHECK(convexHullVolume(points) == Approx(1).epsilon(1e-12));
  points.push_back({0.5f, 0.5f, 1});
  CHECK(convexHullVolume(points) == Approx(1).epsilon(1e-12));
}
