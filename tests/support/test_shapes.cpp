// The generated meshes are what their documentation says.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/shapes.h"

using namespace shbake;

namespace {

// Volume under the divergence theorem: exact for closed, outward wound meshes wherever the origin lies.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
  }
  return sum;
}

// Half the sum of all edge cross products: zero for a closed mesh, the area vector of a flat one.
Vec3d areaVector(const Mesh& mesh) {
  Vec3d sum;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.positions[t[0]];
    sum += cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a) * 0.5;
  }
  return sum;
}

}  // namespace

TEST_CASE("solids are closed, wound outwards and enclose their volume", "[shapes]") {
  const double corners = 1024, h = 1e-3;
  const double polygon = 0.5 * corners * std::sin(2 * std::numbers::pi / corners);
  const std::pair<Mesh, double> solids[] = {{shapes::cube(), 1},
                                            {shapes::cubeSplit(), 1},
                                            {shapes::box({0, 0, 0}, {1, 2, 3}, {2, 3, 4}), 6},
                                            {shapes::boxRoom(3), -1},
                                            {shapes::tetrahedron(), 8 / (9 * std::sqrt(3.0))},
                                            {shapes::octahedron(), 4.0 / 3},
                                            {shapes::bicone(1024, h), 2 * polygon * h / 3}};
  for (const auto& [mesh, expected] : solids) {
    INFO(mesh.source);
    CHECK(volume(mesh) == Approx(expected).epsilon(1e-12));
    CHECK(length(areaVector(mesh)) < 1e-12);
  }
}

TEST_CASE("spheres have their counts, radius and side", "[shapes]") {
  const Mesh sphere = shapes::icosphere(3), inward = shapes::inwardSphere(3);
  CHECK(sphere.triangles.size() == 20u << 6);
  CHECK(sphere.positions.size() == (10u << 6) + 2);
  for (const Vec3d& p : sphere.positions) CHECK(length(p) == Approx(1).epsilon(1e-15));
  CHECK(volume(sphere) == Approx(-volume(inward)));
  // Faces with edges up to e lie at least sqrt(1 - e^2/3) from the centre (their circumradius is at most e/sqrt(3)), so
  // the solid contains the ball of that radius and is contained in the unit ball.
  double e = 0;
  for (const Triangle& t : sphere.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      e = std::max(e, length(sphere.positions[t[k]] - sphere.positions[t[(k + 1) % 3]]));
    }
  }
  const double whole = 4 * std::numbers::pi / 3;
  CHECK(e < 0.17);
  CHECK(volume(sphere) < whole);
  CHECK(volume(sphere) > whole * std::pow(1 - e * e / 3, 1.5));
}

TEST_CASE("a bowl's vertices lie on the sphere, inside its angles, with exact normals", "[shapes]") {
  const double aperture = 0.6;
  const Mesh bowl = shapes::bowl(aperture, 12, 20, true);
  REQUIRE(bowl.vertexNormals.size() == bowl.positions.size());
  for (std::size_t v = 0; v < bowl.positions.size(); ++v) {
    CHECK(length(bowl.positions[v]) == Approx(1).epsilon(1e-15));
    CHECK(bowl.positions[v].z <= std::cos(aperture) + 1e-15);
    CHECK(bowl.vertexNormals[v] == Vec3f(-bowl.positions[v]));
  }
  for (const Triangle& t : bowl.triangles) {
    const Vec3d a = bowl.positions[t[0]], b = bowl.positions[t[1]], c = bowl.positions[t[2]];
    CHECK(dot(cross(b - a, c - a), a + b + c) < 0);
  }
}

TEST_CASE("open shapes face where they say", "[shapes]") {
  CHECK(length(areaVector(shapes::grid({1, 2, 3}, {2, 0, 0}, {0, 3, 0}, 4, 5)) - Vec3d(0, 0, 6)) < 1e-14);
  const Vec3d inside = areaVector(shapes::corner(4));
  for (double component : {inside.x, inside.y, inside.z}) CHECK(component == Approx(1).epsilon(1e-14));
  CHECK(shapes::corner(4).positions[0] == Vec3d());
  CHECK(length(areaVector(shapes::parallelSheets(0.5, 2))) < 1e-14);
  // Walls in pairs cancel; roofs, each at least 0.3 x 0.3 and at most 0.7 x 0.7, add to the ground's 3 x 3.
  const Vec3d city = areaVector(shapes::city(3, 2, 4));
  CHECK(std::abs(city.x) + std::abs(city.y) < 1e-12);
  CHECK(city.z > 9 + 9 * 0.09);
  CHECK(city.z < 9 + 9 * 0.49);
}

TEST_CASE("a room of colours has a colour for every face", "[shapes]") {
  for (const Mesh& mesh : {shapes::cornellRoom(), shapes::redFloorWhiteWall()}) {
    CHECK(mesh.faceColors.size() == mesh.triangles.size());
  }
}

TEST_CASE("every generated triangle refers to vertices that exist", "[shapes]") {
  std::vector<Mesh> all = shapes::defects();
  for (const Mesh& solid : shapes::convexSolids()) all.push_back(solid);
  for (const Mesh& scene : {shapes::openCavity(3, 0.08, 25), shapes::columns(2, 12), shapes::chessPiece(1),
                            shapes::tiltedBoxesOnGround(), shapes::tJunctionFloor(), shapes::lidAboveApex(1e-4),
                            shapes::discAboveFloor(1, 2, 32), shapes::floorBesideWall(1, 1, 10)}) {
    all.push_back(scene);
  }
  for (const Mesh& mesh : all) {
    INFO(mesh.source);
    CHECK_FALSE(mesh.triangles.empty());
    for (const Triangle& t : mesh.triangles) {
      for (std::uint32_t v : t) CHECK(v < mesh.positions.size());
    }
  }
}

TEST_CASE("shuffling keeps the triangles and their winding", "[shapes]") {
  const Mesh mesh = shapes::icosphere(1, 0.1);
  const shapes::Shuffled shuffled = shapes::shuffled(mesh, 5);
  REQUIRE(shuffled.mesh.triangles.size() == mesh.triangles.size());
  CHECK(shuffled.mesh.triangles != mesh.triangles);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& original = mesh.triangles[shuffled.faceSource[i]];
    Triangle back = shuffled.mesh.triangles[i];
    for (std::uint32_t& v : back) v = shuffled.vertexSource[v];
    const bool sameCycle = back == original || Triangle{back[1], back[2], back[0]} == original ||
                           Triangle{back[2], back[0], back[1]} == original;
    CHECK(sameCycle);
  }
}

TEST_CASE("a rotation about z turns x towards y", "[shapes]") {
  const Vec3d turned = shapes::apply(shapes::rotationAbout({0, 0, 2}, std::numbers::pi / 2), {1, 0, 0});
  CHECK(length(turned - Vec3d(0, 1, 0)) < 1e-15);
}
