// The fan test against arcs intersected one by one in extended precision, on random fans and on all shapes.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "bake/fan_test.h"
#include "bake/support.h"
#include "bake/visibility_judge.h"
#include "support/oracle_visibility.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// A fan of `n` faces around vertex 0 at the origin, its spokes at the heights that `height(azimuth)` gives and at
/// random lengths. Open fans leave out the last face. Normals are +z, so that the fan is one lighting point.
Mesh fan(int n, const std::function<double(double)>& height, bool open, std::uint64_t seed) {
  Mesh mesh;
  mesh.source = "fan";
  mesh.positions.push_back({0, 0, 0});
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * kPi * (i + 0.6 * hashUnit(seed, std::uint64_t(2 * i))) / n;
    const double reach = 0.2 + hashUnit(seed, std::uint64_t(2 * i + 1));
    mesh.positions.push_back(Vec3d(std::cos(phi), std::sin(phi), height(phi)) * reach);
  }
  for (int i = 0; i < (open ? n - 1 : n); ++i) {
    mesh.triangles.push_back({0, std::uint32_t(i + 1), std::uint32_t((i + 1) % n + 1)});
  }
  mesh.vertexNormals.assign(mesh.positions.size(), {0, 0, 1});
  return mesh;
}

struct Count {
  long asked = 0, blocked = 0, either = 0, wrong = 0, aboveHeight = 0, oracleDiffers = 0;
};

/// Asks the fan test and both twins about random directions above the tangent plane of a point.
void ask(const LightingPoints& points, std::uint32_t p, int groups, Count& count) {
  VisibilityJudge judge(points);
  judge.setPoint(p);
  const Contacts contacts = contactsOf(points);
  FanTest test(points, contacts);
  test.setPoint(p);
  // The oracle takes the first of several widest faces, does not leave out fans below the tangent plane, and looks at
  // shared corners alone.
  const bool comparable =
      judge.fanHeight() > 1e-6 && judge.startIsUnique() && contacts.of(points.pointPosition[p]).empty();
  for (int g = 0; g < groups; ++g) {
    float x[16], y[16], z[16];
    std::uint32_t faces[16];
    std::vector<Vec3d> d(16);
    for (std::size_t i = 0; i < 16; ++i) {
      d[i] = randomDirection(p + 1, std::uint64_t(16 * g) + i);
      const double up = dot(d[i], Vec3d(points.pointNormal[p]));
      if (up < 0) d[i] = -d[i];
      x[i] = float(d[i].x);
      y[i] = float(d[i].y);
      z[i] = float(d[i].z);
    }
    const std::uint32_t mask = test.height() == 0 ? 0 : test.blocked(x, y, z, faces);
    for (std::size_t i = 0; i < 16; ++i) {
      const bool blocked = (mask >> i & 1) != 0;
      const Sees expected = judge.atPosition(d[i]);
      ++count.asked;
      count.blocked += blocked;
      if (expected == Sees::either) {
        ++count.either;
        continue;
      }
      count.wrong += blocked != (expected == Sees::face);
      if (comparable) count.oracleDiffers += (expected == Sees::face) != oracle::blockedByFan(points, p, d[i]);
      // Above its height the fan gives one answer.
      if (dot(d[i], Vec3d(points.pointNormal[p])) >= double(test.height())) {
        count.aboveHeight += blocked != test.blocksZenith();
      }
      // A blocking face is one of those that touch the position.
      if (blocked) {
        const auto around = points.positionFaces[points.pointPosition[p]];
        const auto lainOn = contacts.of(points.pointPosition[p]);
        REQUIRE((std::find(around.begin(), around.end(), faces[i]) != around.end() ||
                 std::any_of(lainOn.begin(), lainOn.end(), [&](const Contact& c) { return c.face == faces[i]; })));
      }
    }
  }
}

void checkAll(const Count& count) {
  INFO(count.asked << " directions, " << count.blocked << " blocked, " << count.either << " left out near an arc");
  CHECK(count.wrong == 0);
  CHECK(count.oracleDiffers == 0);
  CHECK(count.aboveHeight == 0);
  CHECK(count.asked > 0);
  // Margins of 1e-6 around a dozen arcs hold a few directions in a hundred thousand.
  CHECK(count.either <= 4 + count.asked / 1000);
}

Count askFans(const std::function<double(double)>& height, bool open) {
  Count count;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const int n = 3 + int(seed % 9);
    const Mesh mesh = fan(n, height, open, seed);
    const LightingPoints points = pointsOf(mesh);
    ask(points, pointOfVertex(points, 0), 16, count);
  }
  return count;
}

}  // namespace

TEST_CASE("convex fans block nothing", "[fan_test]") {
  const Count count = askFans([](double) { return -0.4; }, false);
  checkAll(count);
  CHECK(count.blocked == 0);
}

TEST_CASE("concave fans block what lies below their edges", "[fan_test]") {
  const Count count = askFans([](double) { return 0.5; }, false);
  checkAll(count);
  CHECK(count.blocked > count.asked / 20);
}

TEST_CASE("saddles block two sides", "[fan_test]") {
  const Count count = askFans([](double phi) { return 0.8 * std::cos(2 * phi); }, false);
  checkAll(count);
  CHECK(count.blocked > 0);
}

TEST_CASE("irregular and open fans agree with their arcs", "[fan_test]") {
  checkAll(askFans([](double phi) { return 2 * std::sin(5 * phi) * std::cos(3 * phi + 1); }, false));
  checkAll(askFans([](double phi) { return 2 * std::sin(5 * phi) * std::cos(3 * phi + 1); }, true));
  checkAll(askFans([](double) { return 0.5; }, true));
}

TEST_CASE("coincident faces are one wall", "[fan_test]") {
  for (const bool turned : {false, true}) {
    for (const bool doubledFirst : {false, true}) {
      // A concave fan whose faces come twice, as the sides of a doubled sheet do or as plain duplicates.
      Mesh mesh = fan(
          6, [](double) { return 0.5; }, false, 3);
      std::vector<Triangle> again = mesh.triangles;
      if (turned) {
        for (Triangle& t : again) std::swap(t[1], t[2]);
      }
      mesh.triangles.insert(doubledFirst ? mesh.triangles.begin() : mesh.triangles.end(), again.begin(), again.end());
      mesh.vertexNormals.clear();
      const LightingPoints points = pointsOf(mesh, {1, 1, 1}, {.creaseDegrees = 180});
      Count count;
      for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (points.positions[points.pointPosition[p]] == points.frame.toWork({0, 0, 0})) ask(points, p, 32, count);
      }
      INFO("turned " << turned << ", doubled first " << doubledFirst);
      checkAll(count);
      CHECK(count.blocked > 0);
    }
  }
}

TEST_CASE("fans agree with their arcs at every point of every shape", "[fan_test]") {
  std::vector<Mesh> meshes = shapes::convexSolids();
  for (Mesh& mesh : shapes::defects()) meshes.push_back(std::move(mesh));
  meshes.insert(meshes.end(),
                {shapes::boxRoom(2), shapes::corner(2), shapes::inwardSphere(1, 0.2), shapes::icosphere(2, 0.2),
                 shapes::openCavity(2, 0.1, 30), shapes::cubeSplit(), shapes::bowl(1, 4, 8), shapes::bicone(64, 0.01),
                 shapes::tJunctionFloor(), shapes::city(1, 1, 3), shapes::chessPiece(0), shapes::redFloorWhiteWall(2)});
  for (const Mesh& mesh : meshes) {
    const LightingPoints points = pointsOf(mesh);
    Count count;
    const auto step = std::uint32_t(1 + points.size() / 40);
    for (std::uint32_t p = 0; p < points.size(); p += step) ask(points, p, 4, count);
    INFO(mesh.source);
    checkAll(count);
  }
}

TEST_CASE("inside a closed mesh a fan blocks exactly the directions that leave it", "[fan_test]") {
  // Another truth altogether: a step along the direction, far shorter than any face, ends inside or outside the closed
  // surface. Its winding number (Van Oosterom, Strackee, "The solid angle of a plane triangle", IEEE TBME 30, 1983)
  // tells.
  const auto winding = [](const LightingPoints& points, const Vec3d& q) {
    double sum = 0;
    for (const Triangle& t : points.faces) {
      const Vec3d a = Vec3d(points.positions[t[0]]) - q, b = Vec3d(points.positions[t[1]]) - q,
                  c = Vec3d(points.positions[t[2]]) - q;
      const double la = length(a), lb = length(b), lc = length(c);
      sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return std::lround(sum / (4 * kPi));
  };
  for (const Mesh& mesh : {shapes::boxRoom(2), shapes::inwardSphere(2, 0.2), shapes::icosphere(2, 0.3)}) {
    const LightingPoints points = pointsOf(mesh);
    VisibilityJudge judge(points);
    const Contacts contacts = contactsOf(points);
    FanTest test(points, contacts);
    const long inside = winding(points, {0, 0, 0});
    const bool isRoom = inside < 0;  // wound inwards
    long blockedCount = 0;
    for (std::uint32_t p = 0; p < points.size(); p += 3) {
      const Vec3d origin(points.positions[points.pointPosition[p]]), n(points.pointNormal[p]);
      test.setPoint(p);
      judge.setPoint(p);
      for (std::uint64_t i = 0; i < 32; ++i) {
        Vec3d d = randomDirection(p, i);
        if (dot(d, n) < 0) d = -d;
        // Steps of 1e-4 end 1e-4 sin(angle) beside the faces: the winding number is sharp to that distance.
        if (judge.throughFan(d) == Sees::either) continue;
        const bool outside = winding(points, origin + d * 1e-4) == 0;
        const float x[16] = {float(d.x)}, y[16] = {float(d.y)}, z[16] = {float(d.z)};
        std::uint32_t faces[16];
        const bool blocked = test.height() > 0 && (test.blocked(x, y, z, faces) & 1) != 0;
        blockedCount += blocked;
        REQUIRE(blocked == (outside == isRoom));
      }
    }
    CHECK(blockedCount > 0);
  }
}

TEST_CASE("a point knows the fronts of its fan", "[fan_test]") {
  // A sheet and its underside share positions but not normals: each point is in front of its own faces only.
  Mesh mesh = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2);
  const LightingPoints points = pointsOf(mesh);
  const std::uint32_t p = pointOfVertex(points, 4);
  const Contacts none;
  FanTest test(points, none);
  test.setPoint(p);
  CHECK(test.height() == 0);

  // In a room's corner every wall shows its front; on a box's corner no side shows another its front.
  for (const bool room : {true, false}) {
    const LightingPoints solid = pointsOf(room ? shapes::boxRoom(1) : shapes::cube());
    FanTest corner(solid, none);
    for (std::uint32_t q = 0; q < solid.size(); ++q) {
      corner.setPoint(q);
      if (corner.height() == 0) {
        CHECK_FALSE(room);
        continue;
      }
      CHECK(room);
      for (const std::uint32_t f : solid.positionFaces[solid.pointPosition[q]]) {
        const Triangle& own = solid.facePoints[f];
        if (std::find(own.begin(), own.end(), q) == own.end()) CHECK(corner.facesFront(f));
      }
    }
  }
}
