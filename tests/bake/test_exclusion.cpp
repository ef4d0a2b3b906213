// Which hits count: no light leaks and none is lost at contact, in corners, among slivers, far from the origin.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "bake/point_tracer.h"
#include "bake/ray_scene.h"
#include "bake/support.h"
#include "bake/visibility_judge.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Verdict {
  long directions = 0;
  long leaks = 0;   // seen as sky where a face is
  long losses = 0;  // seen as a face where the sky is
  long either = 0;  // too near an edge for float arithmetic to be held to an answer
};

/// Compares what every `step`-th point sees with the judge, and the two ways of looking with each other.
Verdict compare(const LightingPoints& points, int rays, double far = kInfinity, std::uint32_t step = 1) {
  Progress progress;
  const RayScene scene(points, float(far), Parallel(1), progress);
  const DirectionSet set(rays, 1);
  PointTracer tracer(points, scene, set, 1, true);
  VisibilityJudge judge(points, far);
  std::vector<std::uint16_t> sky(std::size_t(set.groups())), again(sky.size());
  std::vector<Hit> hits;
  Verdict v;
  for (std::uint32_t p = 0; p < points.size(); p += step) {
    judge.setPoint(p);
    tracer.look(p, sky);
    hits.clear();
    tracer.lookForHits(p, again, hits);
    const std::vector<Vec3d> directions = directionsOf(points, p, set, 1);
    long blocked = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const bool sees = (sky[i / 16] >> (i % 16) & 1) != 0;
      blocked += (again[i / 16] >> (i % 16) & 1) == 0;
      const Sees truth = judge.look(directions[i]);
      ++v.directions;
      v.either += truth == Sees::either;
      v.leaks += sees && truth == Sees::face;
      v.losses += !sees && truth == Sees::sky;
      // Two traversals of one scene may differ on an edge only.
      if (truth != Sees::either) REQUIRE(sees == ((again[i / 16] >> (i % 16) & 1) != 0));
    }
    REQUIRE(long(hits.size()) == blocked);  // with both sides reflecting, every blocked direction is a hit
  }
  return v;
}

void checkNoneWrong(const Mesh& mesh, int rays = 256, std::uint32_t step = 1) {
  const Verdict v = compare(pointsOf(mesh), rays, kInfinity, step);
  INFO(mesh.source << ": " << v.directions << " directions, " << v.either << " of them within rounding of an edge");
  CHECK(v.leaks == 0);
  CHECK(v.losses == 0);
  // The margins are angles near 2e-6, wider only where an edge passes the point within a hundredth of its own length.
  // The share of directions that they take is that angle times the length of the edges seen, some dozen radians.
  CHECK(v.either <= 5 + v.directions / 2000);
}

/// shapes::lidAboveApex() with the lid's diagonal beside the apex: above it, each direction would be near an edge.
Mesh asymmetricLid(double gap) {
  Mesh mesh = shapes::merged(shapes::bicone(64, 0.01), shapes::grid({-2.5, -1.5, 0.01 + gap}, {0, 4, 0}, {5, 0, 0}));
  mesh.source = "asymmetric lid";
  return mesh;
}

std::vector<Mesh> hardScenes() {
  return {shapes::boxesOnGround(),  shapes::tiltedBoxesOnGround(),
          shapes::tJunctionFloor(), shapes::boxRoom(1),
          shapes::boxRoom(3),       shapes::corner(3),
          shapes::cube(),           shapes::conesTipToTip(),
          shapes::bowTie(),         shapes::threeFacesOnEdge(),
          shapes::duplicateFaces(), shapes::moebiusStrip()};
}

}  // namespace

TEST_CASE("a lid just above an apex blocks its whole sky", "[exclusion]") {
  for (const double gap : {1e-2, 1e-4, 1e-5, 1e-6}) {
    for (const double tilt : {0.0, 0.4}) {
      const Mesh mesh = shapes::rotated(shapes::lidAboveApex(gap), shapes::rotationAbout({0, 1, 0}, tilt));
      const LightingPoints points = pointsOf(mesh);
      const std::uint32_t apex = pointOfVertex(points, 64);
      const PointBake bake = bakeSome(points, {apex}, optionsOf(TransferKind::shadowed, 1, 1024));
      INFO("gap " << gap << ", tilt " << tilt);
      // The lid's edge is 2 away: the sky below it is at most (gap / 2)^2 of the cosine-weighted hemisphere.
      CHECK(double(bake.transfer.visibility[apex]) <= gap * gap / 4 + 1.0 / 1024);
    }
  }
  for (const double gap : {1e-4, 1e-6}) checkNoneWrong(asymmetricLid(gap));
}

TEST_CASE("contact, corners and junctions: no direction is wrong", "[exclusion]") {
  for (const Mesh& mesh : hardScenes()) checkNoneWrong(mesh);
}

TEST_CASE("tilted at any angle, contact loses no direction", "[exclusion]") {
  for (int i = 0; i < 3; ++i) {
    const auto turn = shapes::rotationAbout({1, 2, double(i)}, 0.3 + 0.7 * i);
    checkNoneWrong(shapes::rotated(shapes::tiltedBoxesOnGround(), turn));
    checkNoneWrong(shapes::rotated(shapes::tJunctionFloor(), turn));
    checkNoneWrong(shapes::rotated(asymmetricLid(1e-6), turn));
  }
}

TEST_CASE("nor far from the origin or in tiny units", "[exclusion]") {
  for (const double far : {1e4, 1e6}) {
    checkNoneWrong(shapes::translated(shapes::tiltedBoxesOnGround(), {far, -far, far}));
    checkNoneWrong(shapes::translated(shapes::corner(3), {far, far, -far}));
    checkNoneWrong(shapes::translated(asymmetricLid(1e-4), {-far, far, far}));
  }
  for (const double unit : {1e-12, 1e12}) {
    checkNoneWrong(shapes::scaled(shapes::tiltedBoxesOnGround(), unit));
    checkNoneWrong(shapes::scaled(asymmetricLid(1e-4), unit));
  }
}

TEST_CASE("slivers, at the tip and at the rim of a fan", "[exclusion]") {
  checkNoneWrong(shapes::bicone(1024, 1e-3), 64, 7);
  checkNoneWrong(shapes::bicone(12, 40));
  checkNoneWrong(shapes::flipped(shapes::bicone(256, 0.3)), 64, 3);
}

TEST_CASE("curved, concave and cluttered meshes", "[exclusion]") {
  checkNoneWrong(shapes::inwardSphere(3, 0.1), 64, 8);
  checkNoneWrong(shapes::openCavity(3, 0.1, 20), 64, 8);
  checkNoneWrong(shapes::chessPiece(0), 64, 8);
  checkNoneWrong(shapes::city(2, 2, 3), 64, 2);
  checkNoneWrong(shapes::cornellRoom(3), 64, 2);
}

TEST_CASE("nothing leaks out of a closed room, at any vertex", "[exclusion]") {
  for (const Mesh& mesh : {shapes::boxRoom(1), shapes::boxRoom(4), shapes::inwardSphere(0), shapes::inwardSphere(3),
                           shapes::inwardSphere(3, 0.1), shapes::inwardSphere(3, 0.25)}) {
    for (const auto normals : {NormalSource::smooth, NormalSource::flat}) {
      const LightingPoints points = pointsOf(mesh, {1, 1, 1}, {.normals = normals});
      const PointBake bake = bakeAll(points, optionsOf(TransferKind::shadowed, 3, 256));
      INFO(mesh.source);
      float most = 0;
      for (const float v : bake.transfer.visibility) most = std::max(most, v);
      CHECK(most == 0);
      for (const float c : bake.transfer.coefficients) REQUIRE(c == 0);
    }
  }
}

TEST_CASE("a closed room made of doubled sheets does not leak either", "[exclusion]") {
  for (const bool insideFirst : {true, false}) {
    const Mesh inside = shapes::boxRoom(2);
    Mesh mesh = insideFirst ? inside : shapes::flipped(inside);
    const std::vector<Triangle> once = mesh.triangles;
    for (const Triangle& t : once) mesh.triangles.push_back({t[0], t[2], t[1]});
    // Three squares' normals at a corner and their opposites: flat, so that no normal is a mean of both sides.
    const LightingPoints points = pointsOf(mesh, {1, 1, 1}, {.normals = NormalSource::flat});
    const PointBake bake = bakeAll(points, optionsOf(TransferKind::shadowed, 1, 256));
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      const bool inwards = dot(points.pointNormal[p], points.positions[points.pointPosition[p]]) < 0;
      INFO("inside first " << insideFirst << ", inwards " << inwards);
      CHECK(bake.transfer.visibility[p] == (inwards ? 0.0f : 1.0f));
    }
  }
}

TEST_CASE("faces beyond the greatest distance neither block nor reflect", "[exclusion]") {
  const LightingPoints points = pointsOf(shapes::corner(3));
  for (const double far : {0.1, 0.3, 0.5, 2.0}) {
    const Verdict v = compare(points, 256, far);
    INFO(far << ": " << v.either << " within rounding");
    CHECK(v.leaks == 0);
    CHECK(v.losses == 0);
    CHECK(v.either <= 5 + v.directions / 2000);
  }
  // In file units: a wall 3 units of length 1/1024 away.
  const Mesh wall = shapes::scaled(shapes::merged(shapes::grid({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 2, 2),
                                                  shapes::flipped(shapes::grid({-9, -9, 3}, {18, 0, 0}, {0, 18, 0}))),
                                   0x1p-10);
  const LightingPoints sheets = pointsOf(wall);
  const std::uint32_t middle = pointOfVertex(sheets, 4);
  BakeOptions options = optionsOf(TransferKind::shadowed, 1, 4096);
  options.maxDistance = 2.999 * 0x1p-10;
  CHECK(bakeSome(sheets, {middle}, options).transfer.visibility[middle] == 1);
  options.maxDistance = 6 * 0x1p-10;
  // Within 6 of a plane at 3: the cone of 60 degrees, sin^2 = 3/4. The lattice's rings count it to 1/N.
  CHECK(double(bakeSome(sheets, {middle}, options).transfer.visibility[middle]) ==
        Approx(0.25).margin(1.0 / 4096 + 1e-6));
}

TEST_CASE("contact is judged by the distance to the plane: grazing rays pass, near lids block", "[ray_scene]") {
  // A ground below a point by 0.4 ulp of the coordinate scale 1, and one by 4 ulp: rays that graze and rays that fall.
  for (const double ulps : {-0.4, 0.4, 4.0}) {
    Mesh mesh = shapes::grid({-1, -1, ulps * double(std::numeric_limits<float>::epsilon())}, {2, 0, 0}, {0, 2, 0});
    mesh = shapes::merged(mesh, shapes::grid({0, 0, 0}, {0.5, 0, 0}, {0, 0, 0.5}));
    // The frame's centre has to be the origin, or rounding takes the gap away.
    mesh = shapes::merged(mesh, shapes::grid({-1, -1, -1}, {0.1, 0, 0}, {0, 0.1, 0}));
    mesh = shapes::merged(mesh, shapes::grid({-1, -1, 1}, {0.1, 0, 0}, {0, 0.1, 0}));
    const LightingPoints points = pointsOf(mesh);
    REQUIRE(points.frame.centre == Vec3d());
    std::uint32_t position = LightingPoints::kNone;
    for (std::uint32_t p = 0; p < points.positions.size(); ++p) {
      if (points.positions[p] == Vec3f(0, 0, 0)) position = p;
    }
    REQUIRE(position != LightingPoints::kNone);
    Progress progress;
    const RayScene scene(points, float(kInfinity), Parallel(1), progress);
    const RayScene::BuffersPtr buffers = scene.makeBuffers();
    std::vector<float> x(16), y(16), z(16);
    for (std::size_t i = 0; i < 16; ++i) {
      // Elevations 1e-6 .. 1 towards the ground's side.
      const double rise = std::pow(10.0, -6 + double(i) * 6 / 15.5) * (ulps < 0 ? -1 : 1);
      const Vec3d d = normalized(Vec3d(0.6, 0.7, rise));
      x[i] = float(d.x);
      y[i] = float(d.y);
      z[i] = float(d.z);
    }
    const std::uint16_t active = 0xFFFF;
    std::uint16_t hit = 0;
    scene.occluded({position, 1, x.data(), y.data(), z.data(), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, &active}, *buffers,
                   &hit);
    INFO(ulps << " ulp");
    CHECK(hit == (ulps > 1 ? 0xFFFF : 0));
  }
}
