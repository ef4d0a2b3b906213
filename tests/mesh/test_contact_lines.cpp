// The lines along which faces meet flat patches.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/flat_parts.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

/// The lines on the patch of the first face.
std::vector<Polyline> linesOnFirst(const Mesh& mesh) {
  Progress progress;
  FlatParts parts = findFlatParts(mesh, {}, progress);
  addPatches(parts, mesh, progress);
  REQUIRE(parts.patches.ofFace[0] != FlatPatches::kNone);
  CHECK(parts.contacts.starts.size() == parts.patches.size() + 1);
  const auto first = parts.contacts[parts.patches.ofFace[0]];
  return {first.begin(), first.end()};
}

double lengthOf(const Polyline& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.places.size(); ++i) sum += length(line.places[i] - line.places[i - 1]);
  return line.closed ? sum + length(line.places.front() - line.places.back()) : sum;
}

Mesh floorOf(int cells = 1) {
  return shapes::grid({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, cells, cells);
}

}  // namespace

TEST_CASE("a box that stands on the floor leaves its outline", "[refine]") {
  for (const int cells : {1, 7}) {
    const auto lines = linesOnFirst(shapes::merged(floorOf(cells), shapes::box({-0.5, -0.25, 0}, {0.5, 0.25, 1})));
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].closed);
    CHECK(lines[0].places.size() == 4);
    CHECK(lengthOf(lines[0]) == 3);
  }
}

TEST_CASE("a box that is sunk into the floor leaves the line where it goes through", "[refine]") {
  const auto lines = linesOnFirst(shapes::merged(floorOf(3), shapes::box({-0.5, -0.25, -0.3}, {0.5, 0.25, 1})));
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].closed);
  CHECK(lengthOf(lines[0]) == Approx(3).epsilon(1e-12));
  for (const Vec3d& p : lines[0].places) CHECK(std::abs(p.z) < 1e-12);
}

TEST_CASE("lines end where the patch does", "[refine]") {
  // A box over an edge of the floor: three of its sides remain.
  const auto lines = linesOnFirst(shapes::merged(floorOf(), shapes::box({1.5, -0.25, 0}, {2.5, 0.25, 1})));
  REQUIRE(lines.size() == 1);
  CHECK_FALSE(lines[0].closed);
  CHECK(lengthOf(lines[0]) == Approx(1.5).epsilon(1e-12));
}

TEST_CASE("a fence leaves one line, a carpet its border, a doubled carpet none", "[refine]") {
  const Mesh fence = shapes::grid({-1, 0, 0}, {2, 0, 0}, {0, 0, 1}, 4, 1);
  const auto lines = linesOnFirst(shapes::merged(floorOf(), fence));
  REQUIRE(lines.size() == 1);
  CHECK_FALSE(lines[0].closed);
  CHECK(lengthOf(lines[0]) == 2);
  const Mesh carpet = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 3, 3);
  const auto border = linesOnFirst(shapes::merged(floorOf(), carpet));
  REQUIRE(border.size() == 1);
  CHECK(border[0].closed);
  CHECK(lengthOf(border[0]) == Approx(8).epsilon(1e-12));
  CHECK(linesOnFirst(shapes::merged(floorOf(), shapes::flipped(floorOf()))).empty());
}

TEST_CASE("faces that share edges, hover or touch in a point leave no line", "[refine]") {
  CHECK(linesOnFirst(shapes::cube()).empty());
  CHECK(linesOnFirst(shapes::merged(floorOf(), shapes::box({-0.5, -0.5, 1e-3}, {0.5, 0.5, 1}))).empty());
  CHECK(linesOnFirst(shapes::merged(floorOf(), shapes::translated(shapes::octahedron(), {0, 0, 1}))).empty());
}

TEST_CASE("a cone's line turns at each of its faces, and lines of two bodies stay apart", "[refine]") {
  const Mesh cone = shapes::bicone(24, 1);
  const auto lines = linesOnFirst(shapes::merged(shapes::merged(floorOf(), shapes::translated(cone, {-0.9, 0, 0.25})),
                                                 shapes::translated(cone, {0.9, 0.1, 0.25})));
  REQUIRE(lines.size() == 2);
  for (const Polyline& line : lines) {
    CHECK(line.closed);
    CHECK(line.places.size() == 24);
  }
}

TEST_CASE("lines are found on tilted ground, to the rounding of floats", "[refine]") {
  Mesh mesh = shapes::tiltedBoxesOnGround();
  for (Vec3d& p : mesh.positions) p = roundedToFloat(p);
  const auto lines = linesOnFirst(mesh);
  CHECK(lines.size() == 10);
  double sum = 0;
  for (const Polyline& line : lines) {
    CHECK(line.closed);
    CHECK(line.places.size() == 4);
    sum += lengthOf(line);
  }
  CHECK(sum == Approx(4 + 9 * 0.4).epsilon(1e-6));
}
