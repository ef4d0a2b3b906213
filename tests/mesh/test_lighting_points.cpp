// Lighting points: counts, the record of how they came about, independence of order, scale and place.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "mesh/lighting_points.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

constexpr std::uint32_t kNone = LightingPoints::kNone;

LightingPoints pointsOf(const Mesh& mesh, const LightingPointOptions& options = {}, const Albedo& albedo = {}) {
  Progress progress;
  return makeLightingPoints(mesh, options, albedo, progress);
}

std::size_t countOf(const Mesh& mesh, const LightingPointOptions& options = {}) {
  return pointsOf(mesh, options).size();
}

// Corner k of face f of the mesh as a corner of the face as it was turned.
std::size_t turnedCorner(const LightingPoints& points, std::size_t f, std::size_t k) {
  return points.turned[f] && k > 0 ? 3 - k : k;
}

bool isDegenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// No face is lost, and every corner leads to its own place in all tables.
void checkFaces(const Mesh& mesh, const LightingPoints& points) {
  const std::size_t faces = mesh.triangles.size();
  REQUIRE(points.faces.size() == faces);
  REQUIRE(points.facePoints.size() == faces);
  REQUIRE(points.turned.size() == faces);
  REQUIRE(points.outputFaces.size() == faces);
  std::vector<bool> usedPoint(points.size()), usedPosition(points.positions.size());
  for (std::size_t f = 0; f < faces; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t c = turnedCorner(points, f, k);
      const std::uint32_t point = points.facePoints[f][c], vertex = mesh.triangles[f][k];
      REQUIRE(point < points.size());
      usedPoint[point] = true;
      usedPosition[points.faces[f][c]] = true;
      CHECK(points.pointPosition[point] == points.faces[f][c]);
      CHECK(points.positions[points.faces[f][c]] == points.frame.toWork(mesh.positions[vertex]));
      const std::uint32_t output = points.outputFaces[f][k];
      REQUIRE(output < points.outputPoint.size());
      CHECK(points.outputPoint[output] == point);
      CHECK(points.outputSource[output] == vertex);
    }
  }
  CHECK(std::count(usedPoint.begin(), usedPoint.end(), false) == 0);
  CHECK(std::count(usedPosition.begin(), usedPosition.end(), false) == 0);
}

void checkOutputVertices(const Mesh& mesh, const LightingPoints& points) {
  REQUIRE(points.outputSource.size() == points.outputPoint.size());
  REQUIRE(points.outputPoint.size() >= mesh.positions.size());
  std::vector<bool> used(points.outputPoint.size());
  for (const Triangle& t : points.outputFaces) {
    for (std::uint32_t o : t) used[o] = true;
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::uint32_t o = 0; o < points.outputPoint.size(); ++o) {
    if (o < mesh.positions.size()) CHECK(points.outputSource[o] == o);
    CHECK((points.outputPoint[o] == kNone) == !used[o]);
    CHECK(seen.insert({points.outputSource[o], points.outputPoint[o]}).second);
  }
}

void checkPositionFaces(const LightingPoints& points) {
  REQUIRE(points.positionFaces.size() == points.positions.size());
  std::size_t listed = 0, corners = 0;
  for (std::size_t p = 0; p < points.positions.size(); ++p) {
    std::set<std::uint32_t> faces;
    for (std::uint32_t f : points.positionFaces[p]) {
      const Triangle& t = points.faces[f];
      CHECK(std::count(t.begin(), t.end(), static_cast<std::uint32_t>(p)) == 1);
      CHECK_FALSE(isDegenerate(t));
      CHECK(faces.insert(f).second);
    }
    listed += faces.size();
  }
  for (const Triangle& t : points.faces) corners += isDegenerate(t) ? 0 : 3;
  CHECK(listed == corners);
}

void checkPoints(const LightingPoints& points) {
  CHECK(std::is_sorted(points.pointPosition.begin(), points.pointPosition.end()));
  REQUIRE(points.pointNormal.size() == points.size());
  REQUIRE(points.pointAlbedo.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Components rounded by up to 2^-25 each.
    CHECK(std::abs(length(Vec3d(points.pointNormal[i])) - 1) <= std::sqrt(3.0) * 0x1p-25);
    for (std::size_t j = i; j-- > 0 && points.pointPosition[j] == points.pointPosition[i];) {
      const Vec3f d = points.pointNormal[i] - points.pointNormal[j];
      const bool sameNormal = std::abs(d.x) <= 1e-6f && std::abs(d.y) <= 1e-6f && std::abs(d.z) <= 1e-6f;
      CHECK_FALSE((sameNormal && points.pointAlbedo[i] == points.pointAlbedo[j]));
    }
  }
  for (std::size_t f = 0; f < points.faces.size(); ++f) {
    Vec3d at[3], normals;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = Vec3d(points.positions[points.faces[f][k]]);
      normals += Vec3d(points.pointNormal[points.facePoints[f][k]]);
    }
    // Products of work coordinates round by a few 2^-53.
    CHECK(dot(cross(at[1] - at[0], at[2] - at[0]), normals) >= -0x1p-48);
  }
}

void checkRecord(const Mesh& mesh, const LightingPoints& points) {
  checkFaces(mesh, points);
  checkOutputVertices(mesh, points);
  checkPositionFaces(points);
  checkPoints(points);
}

std::vector<Mesh> variety() {
  std::vector<Mesh> all = shapes::defects();
  for (const Mesh& solid : shapes::convexSolids()) all.push_back(solid);
  for (const Mesh& mesh :
       {shapes::cubeSplit(), shapes::merged(shapes::cube(), shapes::cube()), shapes::boxRoom(4),
        shapes::openCavity(2, 0.08, 25), shapes::city(2, 2, 3), shapes::columns(1, 12), shapes::tiltedBoxesOnGround(),
        shapes::tJunctionFloor(), shapes::bowl(0.5, 6, 12, true), shapes::chessPiece(1)}) {
    all.push_back(mesh);
  }
  return all;
}

// Bit for bit the same positions and points in the same order.
void checkSamePoints(const LightingPoints& a, const LightingPoints& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.pointPosition == b.pointPosition);
  CHECK(a.pointNormal == b.pointNormal);
  CHECK(a.pointAlbedo == b.pointAlbedo);
}

// The points of a face beginning with the smallest position, so that turned corners compare equal.
Triangle canonicalPoints(const LightingPoints& points, std::size_t f) {
  Triangle t = points.facePoints[f];
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

TEST_CASE("a cube has 24 lighting points with flat sides and 8 smooth ones", "[lighting_points]") {
  for (const Mesh& cube : {shapes::cube(), shapes::cubeSplit(), shapes::boxRoom()}) {
    INFO(cube.source);
    CHECK(countOf(cube) == 24);
    CHECK(countOf(cube, {.normals = NormalSource::flat}) == 24);
    CHECK(countOf(cube, {.creaseDegrees = 180}) == 8);
    CHECK(countOf(cube, {.creaseDegrees = 0}) == 24);
  }
  CHECK(pointsOf(shapes::cube()).outputPoint.size() == 24);
  CHECK(pointsOf(shapes::cubeSplit()).outputPoint.size() == 24);
}

TEST_CASE("every table of the record agrees with the mesh", "[lighting_points]") {
  for (const Mesh& mesh : variety()) {
    for (const NormalSource normals : {NormalSource::automatic, NormalSource::smooth, NormalSource::flat}) {
      INFO(mesh.source << ", normals " << static_cast<int>(normals));
      checkRecord(mesh, pointsOf(mesh, {.normals = normals}));
    }
  }
}

TEST_CASE("points do not depend on the order of vertices, faces and corners", "[lighting_points]") {
  for (const Mesh& mesh : variety()) {
    for (const NormalSource normals : {NormalSource::automatic, NormalSource::flat}) {
      INFO(mesh.source << ", normals " << static_cast<int>(normals));
      const LightingPoints original = pointsOf(mesh, {.normals = normals});
      const shapes::Shuffled shuffled = shapes::shuffled(mesh, 11);
      const LightingPoints points = pointsOf(shuffled.mesh, {.normals = normals});
      checkRecord(shuffled.mesh, points);
      checkSamePoints(points, original);
      for (std::size_t f = 0; f < points.faces.size(); ++f) {
        CHECK(canonicalPoints(points, f) == canonicalPoints(original, shuffled.faceSource[f]));
      }
    }
  }
}

TEST_CASE("counts do not depend on scale and place", "[lighting_points]") {
  for (const Mesh& mesh : {shapes::cube(), shapes::icosphere(3, 0.1), shapes::city(2, 2, 3), shapes::bicone(64, 1e-2),
                           shapes::columns(1, 12), shapes::chessPiece(1)}) {
    INFO(mesh.source);
    const std::size_t positions = pointsOf(mesh).positions.size(), count = countOf(mesh);
    for (const Mesh& moved :
         {shapes::scaled(mesh, 1e6), shapes::scaled(mesh, 1e-6), shapes::scaled(mesh, 0x1p-1040),
          shapes::translated(mesh, {1e6, -1e6, 1e6}), shapes::rotated(mesh, shapes::rotationAbout({1, 2, 3}, 0.7))}) {
      CHECK(pointsOf(moved).positions.size() == positions);
      CHECK(countOf(moved) == count);
    }
  }
}

TEST_CASE("a power of two as scale, and an offset that doubles hold, change nothing at all", "[lighting_points]") {
  Mesh mesh = shapes::icosphere(3, 0.1);
  // Coordinates on a lattice of 2^-24 that the offset does not disturb.
  for (Vec3d& p : mesh.positions)
    p = Vec3d(std::round(p.x * 0x1p24), std::round(p.y * 0x1p24), std::round(p.z * 0x1p24)) * 0x1p-24;
  const LightingPoints points = pointsOf(mesh);
  checkSamePoints(pointsOf(shapes::scaled(mesh, 0x1p20)), points);
  checkSamePoints(pointsOf(shapes::translated(mesh, {1e6, -1e6, 3e6})), points);
}

TEST_CASE("the crease at a wall's foot splits, the floor does not", "[lighting_points]") {
  const int n = 8;
  const LightingPoints points = pointsOf(shapes::redFloorWhiteWall(n));
  CHECK(points.positions.size() == (n + 1) * (2 * n + 1));
  CHECK(points.size() == 2 * (n + 1) * (n + 1));
}

TEST_CASE("faces of different albedo share no points, grey and equal ones do", "[lighting_points]") {
  const Mesh grid = shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 1);
  Albedo halves{.per = Albedo::Per::face, .values = {{1, 0, 0}, {1, 0, 0}, {1, 1, 1}, {1, 1, 1}}};
  CHECK(countOf(grid) == 6);
  const LightingPoints split = pointsOf(grid, {}, halves);
  checkRecord(grid, split);
  CHECK(split.size() == 8);
  for (std::size_t f = 0; f < 4; ++f) {
    for (std::uint32_t q : split.facePoints[f]) CHECK(split.pointAlbedo[q] == halves.values[f]);
  }
  halves.values.assign(4, {0.3f, 0.3f, 0.3f});
  CHECK(pointsOf(grid, {}, halves).size() == 6);
}

TEST_CASE("albedo of vertices splits coincident vertices only where it differs", "[lighting_points]") {
  const Mesh cube = shapes::cubeSplit();
  Albedo albedo{.per = Albedo::Per::vertex, .values = std::vector<Rgb>(24, Rgb(0.5f, 0.5f, 0.5f))};
  CHECK(pointsOf(cube, {.creaseDegrees = 180}, albedo).size() == 8);
  albedo.values[5] = {1, 0, 0};
  const LightingPoints points = pointsOf(cube, {.creaseDegrees = 180}, albedo);
  checkRecord(cube, points);
  CHECK(points.size() == 9);
  CHECK(points.pointAlbedo[points.outputPoint[5]] == Rgb(1, 0, 0));
}

TEST_CASE("isolated vertices are written but carry no point", "[lighting_points]") {
  const LightingPoints points = pointsOf(shapes::isolatedVertices());
  CHECK(points.size() == 3);
  REQUIRE(points.outputPoint.size() == 6);
  for (std::uint32_t v : {0u, 3u, 5u}) CHECK(points.outputPoint[v] == kNone);
  for (std::uint32_t v : {1u, 2u, 4u}) CHECK(points.outputPoint[v] < 3);
}

TEST_CASE("a split vertex keeps its first point, further ones are appended in order of use", "[lighting_points]") {
  const Mesh cube = shapes::cube();
  const LightingPoints points = pointsOf(cube);
  std::uint32_t next = 8;
  std::set<std::uint32_t> seen;
  for (std::size_t f = 0; f < cube.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t output = points.outputFaces[f][k];
      if (!seen.insert(output).second) continue;
      if (output < 8) {
        CHECK(output == cube.triangles[f][k]);
      } else {
        CHECK(output == next++);
      }
    }
  }
  CHECK(next == 24);
}

TEST_CASE("coordinates that need doubles are welded and told apart at an offset of a million", "[lighting_points]") {
  // Cells of 1/1024 at 1e6 are below what floats resolve there (1/16), but not doubles.
  const Mesh grid = shapes::translated(shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 32, 32), {1e6, 1e6, 1e6});
  const Mesh both = shapes::merged(grid, shapes::shuffled(grid, 2).mesh);
  CHECK(pointsOf(both).positions.size() == 33 * 33);
}

TEST_CASE("errors name the file, the place and the cause", "[lighting_points]") {
  const auto kindOf = [](const Mesh& mesh, const LightingPointOptions& options, const Albedo& albedo) {
    try {
      Progress progress;
      makeLightingPoints(mesh, options, albedo, progress);
    } catch (const Error& error) {
      return std::pair(error.kind(), std::string(error.what()));
    }
    FAIL("no error");
    return std::pair(ErrorKind::work, std::string());
  };
  const Mesh cube = shapes::cube();
  for (double angle : {-1.0, 180.5, std::nan("")}) {
    CHECK(kindOf(cube, {.creaseDegrees = angle}, {}).first == ErrorKind::usage);
  }
  CHECK(kindOf(cube, {}, {.per = Albedo::Per::face, .values = {{1, 1, 1}}}).first == ErrorKind::usage);
  CHECK(kindOf(cube, {}, {.values = {{std::nanf(""), 1, 1}}}).first == ErrorKind::usage);

  Mesh broken = cube;
  broken.triangles.clear();
  CHECK(kindOf(broken, {}, {}) ==
        std::pair(ErrorKind::work, std::string("cube: the mesh has no faces; light is baked for "
                                               "surfaces only")));
  broken = cube;
  broken.triangles[3][1] = 8;
  CHECK(kindOf(broken, {}, {}) ==
        std::pair(ErrorKind::work, std::string("cube: triangle 3: vertex 8 does not exist; repair the mesh")));
  broken = cube;
  broken.positions[2].y = std::nan("");
  CHECK(kindOf(broken, {}, {}).second.find("vertex 2 is not at a finite position") != std::string::npos);
}
