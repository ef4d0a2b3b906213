// Smooth normals: closed forms, creases, faces that have no say.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "mesh/face_fans.h"
#include "mesh/smooth_normals.h"
#include "mesh/weld.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
// A unit vector rounded to float is off by up to half a unit in the last place (2^-25) in each component.
constexpr double kFloat = 0x1p-24;

struct Normals {
  std::vector<Vec3f> positions;
  std::vector<Triangle> faces;
  SmoothNormals smooth;

  Vec3d at(std::size_t face, std::size_t corner) const {
    const std::uint32_t sector = smooth.ofCorner[3 * face + corner];
    REQUIRE(sector != SmoothNormals::kNone);
    return Vec3d(smooth.normals[sector]);
  }
};

Normals normalsOf(const Mesh& mesh, double creaseDegrees) {
  Progress progress;
  Passes passes(progress, "weld", mesh.triangles.size(), "faces", 4);
  const WorkFrame frame = workFrameOf(mesh, passes);
  const Weld weld = weldPositions(mesh, frame, passes);
  Normals result{weld.positions, {}, {}};
  for (const Triangle& t : mesh.triangles) {
    result.faces.push_back({weld.ofVertex[t[0]], weld.ofVertex[t[1]], weld.ofVertex[t[2]]});
  }
  result.smooth = smoothNormals(result.positions, result.faces, creaseDegrees * kDegree, progress);
  return result;
}

std::size_t sectorsOf(const Mesh& mesh, double creaseDegrees) {
  return normalsOf(mesh, creaseDegrees).smooth.normals.size();
}

// Two triangles that share an edge, their normals at the given angle.
Mesh twoFacesAt(double degrees) {
  Mesh mesh;
  const double a = degrees * kDegree;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {std::cos(a), 0, -std::sin(a)}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("a smooth cube's normals are its diagonals, however its sides are cut into triangles", "[smooth_normals]") {
  // Each of the three sides at a corner weighs in with 90 degrees, in one triangle or in two. (Weighting by face or by
  // area favours the sides that show two triangles.)
  const Mesh cube = shapes::cube();
  const Normals normals = normalsOf(cube, 180);
  CHECK(normals.smooth.normals.size() == 8);
  for (std::size_t f = 0; f < cube.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(length(normals.at(f, k) - normalized(cube.positions[cube.triangles[f][k]])) < 2 * kFloat);
    }
  }
}

TEST_CASE("the normals of a sphere lie within the angular radius of its faces", "[smooth_normals]") {
  for (int level : {0, 1, 2, 3, 4}) {
    INFO(level);
    const Mesh sphere = shapes::icosphere(level);
    const Normals normals = normalsOf(sphere, 60);
    REQUIRE(normals.smooth.normals.size() == sphere.positions.size());
    // A face's normal points at the centre of its circumscribed circle, whose radius is at most e/sqrt(3) for acute
    // triangles with edges up to e; so each face's normal is within asin(e/sqrt(3)) of the exact one at its corners,
    // and a weighted sum of vectors in a cone stays in the cone.
    double longest = 0;
    for (const Triangle& t : sphere.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, length(sphere.positions[t[k]] - sphere.positions[t[(k + 1) % 3]]));
      }
    }
    const double bound = std::asin(longest / std::sqrt(3.0)) + 2 * kFloat;
    double worst = 0;
    for (std::size_t f = 0; f < sphere.triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::max(worst, angleBetween(normals.at(f, k), sphere.positions[sphere.triangles[f][k]]));
      }
    }
    CHECK(worst <= bound);
    // All vertices of the icosahedron, and of its first subdivision, lie on axes of symmetry.
    if (level <= 1) CHECK(worst <= 2 * kFloat);
  }
}

TEST_CASE("two faces share normals up to the crease angle and not beyond", "[smooth_normals]") {
  for (double angle : {10.0, 59.9, 60.1, 120.0, 179.0}) {
    INFO(angle);
    CHECK(sectorsOf(twoFacesAt(angle), angle - 0.01) == 6);
    CHECK(sectorsOf(twoFacesAt(angle), angle + 0.01) == 4);
  }
  CHECK(sectorsOf(shapes::cube(), 89.99) == 24);
  CHECK(sectorsOf(shapes::cube(), 90.01) == 8);
}

TEST_CASE("a crease that ends inside a smooth surface splits its outer end only", "[smooth_normals]") {
  // A cone z = r * 2 (1 - |phi|/pi)^2 of 32 facets: around the apex it has one kink, at phi = 0, of 50 degrees.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  for (int i = 0; i < 32; ++i) {
    const double phi = 2 * std::numbers::pi * i / 32, away = 1 - std::min(i, 32 - i) / 16.0;
    mesh.positions.push_back({std::cos(phi), std::sin(phi), 2 * away * away});
  }
  for (std::uint32_t i = 0; i < 32; ++i) mesh.triangles.push_back({0, i + 1, (i + 1) % 32 + 1});
  const Normals whole = normalsOf(mesh, 60);
  for (std::size_t i = 0; i < 32; ++i) {
    const double bend = angleBetween(faceNormal(whole.positions, whole.faces[i]),
                                     faceNormal(whole.positions, whole.faces[(i + 31) % 32]));
    REQUIRE((i == 0 ? bend > 45 * kDegree : bend < 25 * kDegree));
  }
  CHECK(whole.smooth.normals.size() == 1 + 1 + 31);
  CHECK(sectorsOf(mesh, 35) == 1 + 2 + 31);
}

TEST_CASE("the rim of a lens splits when it is sharper than the crease angle", "[smooth_normals]") {
  // The normals of its two sides differ by 180 degrees less 2 atan(0.01) = 1.15, those of its slivers by less than 0.1.
  CHECK(sectorsOf(shapes::bicone(64, 1e-2), 178.5) == 2 * 64 + 2);
  CHECK(sectorsOf(shapes::bicone(64, 1e-2), 179.5) == 64 + 2);
}

TEST_CASE("the apex of a cone points along its axis whatever the number of slivers", "[smooth_normals]") {
  const Mesh cone = shapes::bicone(1024, 1e-3);
  const Normals normals = normalsOf(cone, 60);
  CHECK(length(normals.at(0, 2) - Vec3d(0, 0, 1)) < 2 * kFloat);
  CHECK(length(normals.at(1, 2) - Vec3d(0, 0, -1)) < 2 * kFloat);
}

TEST_CASE("a face whose three corners lie on a line has no say", "[smooth_normals]") {
  const Normals normals = normalsOf(shapes::collinearFace(), 60);
  for (std::size_t f = 0; f < 5; ++f) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(normals.at(f, k) == Vec3d(0, 0, 1));
  }
  // Nor has it when the rounding of a turned copy gives it some normal or other.
  const shapes::Matrix3 turn = shapes::rotationAbout({1, 2, 3}, 0.7);
  const Normals turned = normalsOf(shapes::rotated(shapes::collinearFace(), turn), 60);
  for (std::size_t f = 0; f < 5; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      // Positions rounded by sqrt(3) * 2^-25 over faces of height 0.5 or more.
      CHECK(length(turned.at(f, k) - shapes::apply(turn, {0, 0, 1})) < 4 * std::sqrt(3.0) * 0x1p-25 / 0.5 + kFloat);
    }
  }
}

TEST_CASE("normals that cancel leave a sector with its first face's", "[smooth_normals]") {
  Mesh pillow;
  pillow.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pillow.triangles = {{0, 1, 2}, {0, 2, 1}};
  const Normals whole = normalsOf(pillow, 180), cut = normalsOf(pillow, 90);
  CHECK(whole.smooth.normals.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(whole.at(0, k).z) == 1);
  CHECK(cut.smooth.normals.size() == 6);
  CHECK(cut.at(0, 0) == Vec3d(0, 0, 1));
  CHECK(cut.at(1, 0) == Vec3d(0, 0, -1));
}

TEST_CASE("corners of degenerate faces have no smooth normal", "[smooth_normals]") {
  const Normals normals = normalsOf(shapes::onlyDegenerate(), 60);
  CHECK(normals.smooth.normals.empty());
  for (std::uint32_t sector : normals.smooth.ofCorner) CHECK(sector == SmoothNormals::kNone);
}

TEST_CASE("a face's normal has the same bits whichever corner comes first", "[smooth_normals]") {
  std::vector<Vec3f> positions;
  for (std::uint64_t i = 0; i < 60; ++i) {
    positions.push_back(Vec3f(Vec3d(hashUnit(1, i), hashUnit(2, i), hashUnit(3, i))));
  }
  for (std::uint32_t i = 0; i + 2 < 60; ++i) {
    const Vec3d normal = faceNormal(positions, {i, i + 1, i + 2});
    CHECK(faceNormal(positions, {i + 1, i + 2, i}) == normal);
    CHECK(faceNormal(positions, {i + 2, i, i + 1}) == normal);
    CHECK(faceNormal(positions, {i, i + 2, i + 1}) == -normal);
  }
  CHECK(faceNormal(positions, {0, 0, 1}) == Vec3d());
}
