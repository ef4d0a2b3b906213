// Which normal a lighting point gets, and which way its faces are turned.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mesh/lighting_points.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

LightingPoints pointsOf(const Mesh& mesh, const LightingPointOptions& options = {}) {
  Progress progress;
  return makeLightingPoints(mesh, options, {}, progress);
}

Mesh withVertexNormals(Mesh mesh, Vec3f normal) {
  mesh.vertexNormals.assign(mesh.positions.size(), normal);
  return mesh;
}

}  // namespace

TEST_CASE("the file's vertex normals are taken at unit length", "[lighting_points]") {
  const Mesh bowl = shapes::bowl(0.4, 8, 16, true);
  Mesh stretched = bowl;
  for (Vec3f& n : stretched.vertexNormals) n *= 7.5f;
  for (const Mesh& mesh : {bowl, stretched}) {
    const LightingPoints points = pointsOf(mesh);
    REQUIRE(points.size() == mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      CHECK(length(Vec3d(points.pointNormal[points.outputPoint[v]]) + normalized(mesh.positions[v])) < 0x1p-22);
    }
  }
}

TEST_CASE("corner normals win over vertex normals and split vertices", "[lighting_points]") {
  Mesh cube = withVertexNormals(shapes::cube(), {0, 0, 1});
  CHECK(pointsOf(cube).size() == 8);
  for (const Triangle& t : cube.triangles) {
    const Vec3d a = cube.positions[t[0]];
    const Vec3d normal = normalized(cross(cube.positions[t[1]] - a, cube.positions[t[2]] - a));
    cube.cornerNormals.insert(cube.cornerNormals.end(), 3, Vec3f(normal));
  }
  const LightingPoints points = pointsOf(cube);
  CHECK(points.size() == 24);
  CHECK(std::count(points.turned.begin(), points.turned.end(), 1) == 0);
  for (std::size_t f = 0; f < cube.triangles.size(); ++f) {
    for (std::uint32_t q : points.facePoints[f]) CHECK(points.pointNormal[q] == cube.cornerNormals[3 * f]);
  }
}

TEST_CASE("options override the file's normals", "[lighting_points]") {
  const Mesh cube = withVertexNormals(shapes::cube(), {0, 0, 1});
  CHECK(pointsOf(cube, {.normals = NormalSource::smooth}).size() == 24);
  CHECK(pointsOf(cube, {.normals = NormalSource::smooth, .creaseDegrees = 180}).size() == 8);
  CHECK(pointsOf(cube, {.normals = NormalSource::flat}).size() == 24);
}

TEST_CASE("a normal that cannot be used gives way to the smooth one", "[lighting_points]") {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Vec3f bad : {Vec3f(), Vec3f(-0.0f, 0, 0), Vec3f(std::nanf(""), 0, 0), Vec3f(0, infinity, 0)}) {
    Mesh grid = withVertexNormals(shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2), {1, 0, 0});
    grid.vertexNormals[4] = bad;
    const LightingPoints points = pointsOf(grid);
    REQUIRE(points.size() == 9);
    for (std::size_t v = 0; v < 9; ++v) {
      CHECK(points.pointNormal[points.outputPoint[v]] == (v == 4 ? Vec3f(0, 0, 1) : Vec3f(1, 0, 0)));
    }
  }
}

TEST_CASE("very short and very long normals are usable", "[lighting_points]") {
  for (float size : {1e-40f, 1e-20f, 1e20f, 3e38f}) {
    const LightingPoints points = pointsOf(withVertexNormals(shapes::icosphere(0), {0, size, 0}));
    for (const Vec3f& n : points.pointNormal) CHECK(n == Vec3f(0, 1, 0));
  }
}

TEST_CASE("normals at one position merge within 1e-6 and not beyond", "[lighting_points]") {
  Mesh cube = withVertexNormals(shapes::cubeSplit(), {0, 0, 1});
  cube.vertexNormals[3] = {0.9e-6f, -0.9e-6f, 1};
  CHECK(pointsOf(cube).size() == 8);
  cube.vertexNormals[3] = {0, 1.2e-6f, 1};
  CHECK(pointsOf(cube).size() == 9);
}

TEST_CASE("a face is turned to the side of its normals, and back for output", "[lighting_points]") {
  const Mesh outward = shapes::icosphere(2);
  Mesh wrong = outward;
  for (const Vec3d& p : outward.positions) wrong.vertexNormals.push_back(Vec3f(p));
  for (std::size_t f = 0; f < wrong.triangles.size(); f += 3) std::swap(wrong.triangles[f][1], wrong.triangles[f][2]);
  const LightingPoints points = pointsOf(wrong);
  CHECK(points.size() == outward.positions.size());
  const LightingPoints straight = pointsOf(outward);
  CHECK(points.faces == straight.faces);
  for (std::size_t f = 0; f < wrong.triangles.size(); ++f) {
    CHECK(points.turned[f] == (f % 3 == 0));
    CHECK(points.outputFaces[f] == wrong.triangles[f]);
  }
}

TEST_CASE("the two sides of a doubled sheet stay apart", "[lighting_points]") {
  const LightingPoints points = pointsOf(shapes::doubledSheet(3));
  CHECK(points.positions.size() == 16);
  REQUIRE(points.size() == 32);
  for (std::size_t q = 0; q < 32; q += 2) {
    CHECK(points.pointNormal[q] == Vec3f(0, 0, -1));
    CHECK(points.pointNormal[q + 1] == Vec3f(0, 0, 1));
  }
}

TEST_CASE("the two sides of a doubled curved sheet are as smooth as one", "[lighting_points]") {
  const Mesh bowl = shapes::bowl(0.5, 8, 16);
  const LightingPoints one = pointsOf(bowl), two = pointsOf(shapes::merged(bowl, shapes::flipped(bowl)));
  REQUIRE(one.size() == bowl.positions.size());
  REQUIRE(two.size() == 2 * one.size());
  for (std::size_t q = 0; q < one.size(); ++q) {
    const Vec3f a = two.pointNormal[2 * q], b = two.pointNormal[2 * q + 1];
    // The other side is summed the other way round, which may round the last place differently.
    const double miss = std::min(length(Vec3d(a - one.pointNormal[q])), length(Vec3d(b - one.pointNormal[q])));
    CHECK(length(Vec3d(a + b)) <= std::sqrt(3.0) * 0x1p-24);
    CHECK(miss <= std::sqrt(3.0) * 0x1p-24);
  }
}

TEST_CASE("a Moebius strip has a point for each vertex and two where its winding breaks", "[lighting_points]") {
  const LightingPoints points = pointsOf(shapes::moebiusStrip(96));
  CHECK(points.positions.size() == 192);
  CHECK(points.size() == 194);
}

TEST_CASE("corners of degenerate faces take the mean of their position's normals, or +z", "[lighting_points]") {
  // The sharp edge 0-1 of two faces at a right angle, and a needle along it.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 1}};
  const LightingPoints points = pointsOf(mesh);
  const Vec3d mean = normalized(Vec3d(1, 0, 1));
  for (std::uint32_t q : points.facePoints[2]) {
    CHECK(length(Vec3d(points.pointNormal[q]) - mean) < 0x1p-23);
  }
  CHECK(points.size() == 2 * 3 + 2);
  for (const Vec3f& n : pointsOf(shapes::onlyDegenerate()).pointNormal) CHECK(n == Vec3f(0, 0, 1));
}
