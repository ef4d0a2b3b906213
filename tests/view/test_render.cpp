// Rendered pixels against closed forms.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "view/light_picture.h"
#include "view/render.h"

using namespace shbake;

namespace {

/// Looks along +y from the origin; the picture shows |x|, |z| <= y / 2.
Camera plainCamera() {
  Camera camera;
  camera.right = {1, 0, 0};
  camera.up = {0, 0, 1};
  camera.forward = {0, 1, 0};
  return camera;
}

RenderOptions plainOptions(int width, int height, int samples) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  options.background.top = options.background.bottom = {0, 0, 0};
  return options;
}

/// A square |x|, |z| <= half, cut into n x n cells of two triangles with jittered inner vertices.
Mesh wall(int n, double half, double depth, double jitter) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const auto k = static_cast<std::uint64_t>(j * (n + 1) + i);
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double dx = inner ? jitter * (hashUnit(1, k) - 0.5) : 0, dz = inner ? jitter * (hashUnit(2, k) - 0.5) : 0;
      mesh.positions.push_back({half * (2 * (i + dx) / n - 1), depth, half * (2 * (j + dz) / n - 1)});
    }
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("triangles that share vertices leave no gap") {
  const Mesh mesh = wall(40, 0.6, 1, 0.9);  // larger than the picture, and far from the grid of samples
  const std::vector<Rgb> white(mesh.positions.size(), Rgb(1, 1, 1));
  for (const int samples : {1, 3}) {
    const Picture picture = render(mesh, white, plainCamera(), plainOptions(211, 173, samples), Parallel(2));
    for (const Rgb& c : picture.pixels) REQUIRE(std::abs(c.x - 1) < 1e-6f);
  }
}

TEST_CASE("edges cover the share of a pixel that lies inside") {
  // The wall ends in the middle of pixel columns 2 and 7 of 10, and of rows likewise.
  const Mesh mesh = wall(1, 0.25, 1, 0);
  const std::vector<Rgb> white(4, Rgb(1, 1, 1));
  const Picture picture = render(mesh, white, plainCamera(), plainOptions(10, 10, 4), Parallel(1));
  CHECK(picture.at(1, 5).x == 0);
  CHECK(picture.at(2, 5).x == Approx(0.5));
  CHECK(picture.at(5, 5).x == Approx(1));
  CHECK(picture.at(7, 5).x == Approx(0.5));
  CHECK(picture.at(2, 2).x == Approx(0.25));
}

TEST_CASE("colours are interpolated in space, not in the picture") {
  // A floor at z = -1/2 from y = 1 to y = 9 whose colour is y: a pixel at height s sees y = -1 / (2 * s * 1/2) = -1 /
  // s.
  Mesh mesh;
  mesh.positions = {{-4, 1, -0.5}, {4, 1, -0.5}, {4, 9, -0.5}, {-4, 9, -0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Rgb> colors{{1, 1, 1}, {1, 1, 1}, {9, 9, 9}, {9, 9, 9}};
  const int size = 400;
  const Picture picture = render(mesh, colors, plainCamera(), plainOptions(size, size, 1), Parallel(2));
  int seen = 0;
  for (int y = 0; y < size; ++y) {
    const double s = 1 - 2 * (y + 0.5) / size, expected = -1 / s;
    if (!(s < 0) || expected < 1.05 || expected > 8.5) continue;
    // Places are rounded to 1/512 of a pixel: y changes by y^2 * 2 / size a pixel.
    CHECK(picture.at(200, y).x == Approx(expected).margin(expected * expected * 2 / size / 256));
    ++seen;
  }
  CHECK(seen > 150);
}

TEST_CASE("the nearest surface wins, and faces turned away can be left out") {
  Mesh mesh = wall(1, 2, 3, 0);
  Mesh front = wall(1, 0.2, 1, 0);
  for (const Vec3d& p : front.positions) mesh.positions.push_back(p);
  for (Triangle t : front.triangles) mesh.triangles.insert(mesh.triangles.begin(), {t[0] + 4, t[2] + 4, t[1] + 4});
  std::vector<Rgb> colors(8, Rgb(0, 1, 0));
  for (std::size_t v = 4; v < 8; ++v) colors[v] = {1, 0, 0};
  RenderOptions options = plainOptions(20, 20, 2);
  CHECK(render(mesh, colors, plainCamera(), options, Parallel(1)).at(10, 10) == Rgb(1, 0, 0));
  CHECK(render(mesh, colors, plainCamera(), options, Parallel(1)).at(2, 10) == Rgb(0, 1, 0));
  // The near wall was turned round; the far one, counter-clockwise for its viewer, stays.
  options.cullBackFaces = true;
  CHECK(render(mesh, colors, plainCamera(), options, Parallel(1)).at(10, 10) == Rgb(0, 1, 0));
}

TEST_CASE("pictures do not depend on threads; bad arguments are refused") {
  const Mesh mesh = wall(12, 0.45, 1, 0.9);
  std::vector<Rgb> colors;
  for (std::uint64_t v = 0; v < mesh.positions.size(); ++v)
    colors.emplace_back(static_cast<float>(hashUnit(3, v)), 0.f, 1.f);
  RenderOptions options = plainOptions(150, 90, 3);
  options.tone = ToneMap{ToneCurve::filmic, 0.5};
  const Picture one = render(mesh, colors, plainCamera(), options, Parallel(1));
  CHECK(render(mesh, colors, plainCamera(), options, Parallel(4)).pixels == one.pixels);
  CHECK_THROWS_AS(render(mesh, std::vector<Rgb>(3), plainCamera(), options, Parallel(1)), Error);
  options.width = 0;
  CHECK_THROWS_AS(render(mesh, colors, plainCamera(), options, Parallel(1)), Error);
}

TEST_CASE("the background is radiance seen through the pixel, or a gradient that is not exposed") {
  RenderOptions options = plainOptions(8, 8, 2);
  options.background.radiance = [](const Vec3d& d) { return Rgb(Vec3d{d.z / d.y, 0, 1}); };
  options.tone.reset();
  const Picture sky = render(Mesh{}, {}, plainCamera(), options, Parallel(1));
  CHECK(sky.at(3, 0).x == Approx(0.5 * 7 / 8));
  CHECK(sky.at(3, 7).x == Approx(-0.5 * 7 / 8));
  options.background = {};
  options.background.top = {0.2f, 0.2f, 0.2f};
  options.background.bottom = {0.6f, 0.6f, 0.6f};
  options.tone = ToneMap{ToneCurve::clip, 10};
  CHECK(render(Mesh{}, {}, plainCamera(), options, Parallel(1)).at(0, 3).x == Approx(0.2 + 0.4 * 3.5 / 8));
}

TEST_CASE("tone curves have the values of their papers") {
  CHECK(displayLight({3, 0.25f, -1}, {ToneCurve::clip, 1}) == Rgb(1, 0.5f, 0));
  CHECK(displayLight({1, 1, 1}, {ToneCurve::reinhard, 0}).x == Approx(0.5));
  CHECK(displayLight({1, 1, 1}, {ToneCurve::filmic, 0}).x == Approx(2.54 / 3.16));
  CHECK(displayLight({1e30f, 1, 1}, {ToneCurve::filmic, 20}).x == 1);
}

TEST_CASE("a drawn light has its directions in place and negatives in magenta") {
  const auto radiance = [](const Vec3d& d) { return d.z < 0 ? Vec3d{-0.5, 1, 1} : Vec3d{d.x, d.y > 0 ? 1.0 : 0.0, 1}; };
  const Picture picture = lightPicture(
      [&](const Vec3d& d) {
        return radiance({std::abs(d.x), d.y, d.z});
      },
      64, 1, {}, Parallel(2));
  REQUIRE(picture.width == 128);
  CHECK(picture.at(64, 31).x > 0.99f);  // the centre is +x
  CHECK(picture.at(32, 31).y == 1);     // +y a quarter to the left
  CHECK(picture.at(96, 31).y == 0);     // -y a quarter to the right
  CHECK(picture.at(10, 50).x == Approx(0.65));
  CHECK(picture.at(10, 50).y == 0);
}
