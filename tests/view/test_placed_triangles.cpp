// Triangles that reach behind the camera, against what is seen of the surface that they lie on.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "view/placed_triangles.h"
#include "view/render.h"

using namespace shbake;

namespace {

/// Stands one above the floor z = 0 and looks along +y; the picture shows |x|, |z - 1| <= y / 2.
Camera standingCamera() {
  Camera camera;
  camera.eye = {0, 0, 1};
  camera.right = {1, 0, 0};
  camera.up = {0, 0, 1};
  camera.forward = {0, 1, 0};
  return camera;
}

/// A floor around the camera, 2 * half wide, in n x n cells with jittered inner vertices.
Mesh floorAround(int n, double half) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const auto k = static_cast<std::uint64_t>(j * (n + 1) + i);
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double dx = inner ? 0.9 * (hashUnit(1, k) - 0.5) : 0, dy = inner ? 0.9 * (hashUnit(2, k) - 0.5) : 0;
      mesh.positions.push_back({half * (2 * (i + dx) / n - 1), half * (2 * (j + dy) / n - 1), 0});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto v = static_cast<std::uint32_t>(j * (n + 1) + i), above = v + static_cast<std::uint32_t>(n) + 1;
      mesh.triangles.push_back({v, v + 1, above + 1});
      mesh.triangles.push_back({v, above + 1, above});
    }
  }
  return mesh;
}

RenderOptions radianceOptions(int width, int height) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = 1;
  options.background.top = options.background.bottom = {-1, -1, -1};
  return options;
}

}  // namespace

TEST_CASE("a floor that goes on behind the camera is cut without a gap, its colours in place") {
  const int size = 300;
  for (const int cells : {1, 2, 31}) {
    const Mesh mesh = floorAround(cells, 100);
    std::vector<Rgb> colors;
    for (const Vec3d& p : mesh.positions) colors.push_back(Rgb(Vec3d{p.x + 200, p.y + 200, 1}));
    const Picture picture = render(mesh, colors, standingCamera(), radianceOptions(size, size), Parallel(2));
    for (int y = 0; y < size; ++y) {
      // A pixel at height s sees the floor at y = -2 / s.
      const double s = 1 - 2 * (y + 0.5) / size, away = -2 / s;
      for (int x = 0; x < size; ++x) {
        const double sideways = (2 * (x + 0.5) / size - 1) * away / 2;
        INFO(cells << " cells, pixel " << x << " " << y);
        if (s > 0 || away > 100.5) {
          REQUIRE(picture.at(x, y).z == -1);
        } else if (away < 99 && std::abs(sideways) < 99) {
          // Places are rounded to 1/512 of a pixel: y moves by y^2 / size a pixel, x by half as much; single precision
          // adds 2^-23 of 300 a few times.
          const double margin = away * away / size / 128 + 2e-4;
          REQUIRE(picture.at(x, y).x == Approx(200 + sideways).margin(margin));
          REQUIRE(picture.at(x, y).y == Approx(200 + away).margin(margin));
        }
      }
    }
  }
}

TEST_CASE("triangles in view are placed as they are, those out of view leave nothing") {
  Mesh mesh;
  mesh.positions = {{0, 2, 1},  {1, 2, 1},   {0, 2, 2},   {0, -2, 1}, {1, -2, 1},
                    {0, -3, 2}, {-50, 1, 1}, {-60, 1, 1}, {-50, 1, 2}};
  mesh.triangles = {{3, 4, 5}, {0, 1, 2}, {6, 7, 8}};
  const std::vector<Rgb> colors(9, Rgb(1, 2, 3));
  const PlacedTriangles placed = placeTriangles(mesh, colors, standingCamera(), 100, 60);
  REQUIRE(placed.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK((placed.corners[0].x == 50 * kGridSteps && placed.corners[0].y == 30 * kGridSteps));
  CHECK((placed.corners[1].x == 100 * kGridSteps && placed.corners[2].y == 0));
  CHECK(placed.corners[0].inverseDepth == 0.5);
  CHECK(placed.corners[1].color == Rgb(1, 2, 3));
}

TEST_CASE("a cut triangle keeps to the frame, whatever its size") {
  Mesh mesh;
  for (const double size : {1.0, 1e3, 1e6}) {
    mesh.positions = {{-size, -size, 0.5}, {size, -size, 0.5}, {0, size, 1.5}};
    mesh.triangles = {{0, 1, 2}};
    Camera camera = standingCamera();
    camera.eye = {0, 0, 0.9};
    const PlacedTriangles placed = placeTriangles(mesh, std::vector<Rgb>(3), camera, 64, 64);
    REQUIRE_FALSE(placed.triangles.empty());
    for (const Triangle& t : placed.triangles) {
      for (const std::uint32_t v : t) {
        REQUIRE(std::abs(placed.corners[v].x - 32 * kGridSteps) <= 8 * 32 * kGridSteps);
        REQUIRE(std::abs(placed.corners[v].y - 32 * kGridSteps) <= 8 * 32 * kGridSteps);
        REQUIRE(placed.corners[v].inverseDepth > 0);
      }
    }
  }
  mesh.positions[0].x = INFINITY;
  CHECK_THROWS_AS(placeTriangles(mesh, std::vector<Rgb>(3), standingCamera(), 64, 64), Error);
}
