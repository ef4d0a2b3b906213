// Places found again on another mesh of the same surface.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/hash.h"
#include "chart/sweep/place_finder.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

PointSurface surfaceOf(const Mesh& mesh) {
  const LightingPoints points = pointsOf(mesh);
  PointSurface surface{{}, points.pointNormal, points.facePoints};
  for (const std::uint32_t p : points.pointPosition) surface.positions.push_back(points.positions[p]);
  return surface;
}

Vec3d positionAt(const PointSurface& surface, const SurfacePlace& place) {
  Vec3d sum;
  for (std::size_t k = 0; k < 3; ++k) {
    sum += Vec3d(surface.positions[surface.faces[place.face][k]]) * place.weights[k];
  }
  return sum;
}

}  // namespace

TEST_CASE("a place is found on the face that it lies on", "[place_finder]") {
  const Mesh mesh = shapes::grid({-1, -1, 0.3}, {2, 0, 0.1}, {0, 2, 0}, 7, 5);
  const PointSurface surface = surfaceOf(mesh);
  const PlaceFinder finder(surface);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto face = static_cast<std::uint32_t>(hashBits(1, i) % surface.faces.size());
    const double root = std::sqrt(hashUnit(2, i)), y = hashUnit(3, i);
    const Vec3f at(positionAt(surface, {face, {1 - root, root * (1 - y), root * y}}));
    const SurfacePlace found = finder.nearest(at, surface.normals[surface.faces[face][0]]);
    CHECK(length(positionAt(surface, found) - Vec3d(at)) < 1e-6);
    CHECK(found.weights[0] + found.weights[1] + found.weights[2] == Approx(1).epsilon(1e-12));
    for (const double w : found.weights) CHECK(w >= 0);
  }
}

TEST_CASE("of two sheets in one place the one that looks the same way is found", "[place_finder]") {
  PointSurface sheets;
  sheets.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheets.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, -1}, {0, 0, -1}, {0, 0, -1}};
  sheets.faces = {{0, 1, 2}, {3, 5, 4}};
  const PlaceFinder finder(sheets);
  CHECK(finder.nearest({0.2f, 0.3f, 0}, {0, 0, 1}).face == 0);
  CHECK(finder.nearest({0.2f, 0.3f, 0}, {0, 0.6f, -0.8f}).face == 1);
  CHECK_THROWS_AS(finder.nearest({0.2f, 0.3f, 0}, {1, 0, 0}), Error);
}

TEST_CASE("faces without an area are no obstacle", "[place_finder]") {
  PointSurface surface;
  surface.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5f, 0, 0}};
  surface.normals.assign(4, {0, 0, 1});
  surface.faces = {{0, 3, 1}, {0, 0, 0}, {0, 1, 2}};
  const SurfacePlace found = PlaceFinder(surface).nearest({0.4f, 0.2f, 0}, {0, 0, 1});
  CHECK(found.face == 2);
  CHECK(found.weights[1] == Approx(0.4));
  CHECK(found.weights[2] == Approx(0.2));
}
