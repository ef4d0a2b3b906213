// The fitted camera: everything in view, nothing nearer would do.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "view/camera.h"

using namespace shbake;

namespace {

std::vector<Vec3d> cloud(const Vec3d& centre, double scale) {
  std::vector<Vec3d> points;
  for (std::uint64_t i = 0; i < 300; ++i) {
    points.push_back(centre + Vec3d{hashUnit(1, 3 * i), 2 * hashUnit(1, 3 * i + 1), hashUnit(1, 3 * i + 2)} * scale);
  }
  return points;
}

}  // namespace

TEST_CASE("a fitted camera shows every point, and touches the margins on one pair of sides") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double azimuth : {0.0, 37.0, 180.0, 301.0}) {
      for (const double elevation : {-90.0, -20.0, 0.0, 65.0, 90.0}) {
        for (const double aspect : {0.5, 1.0, 2.5}) {
          CameraOptions options;
          options.view = {azimuth, elevation};
          options.aspect = aspect;
          options.fieldOfView = 60;
          const auto points = cloud(Vec3d{100, -50, 3} * scale, scale);
          const Camera camera = fitCamera(points, options);
          double left = 1, right = -1, low = 1, high = -1;
          for (const Vec3d& p : points) {
            const auto place = camera.project(p);
            REQUIRE(place.depth > 0);
            left = std::min(left, place.x);
            right = std::max(right, place.x);
            low = std::min(low, place.y);
            high = std::max(high, place.y);
          }
          const double inner = 1 - 2 * options.margin;
          REQUIRE(std::max({-left, right, -low, high}) < inner + 1e-9);
          const bool touchesX = std::abs(-left - inner) < 1e-9 && std::abs(right - inner) < 1e-9;
          const bool touchesY = std::abs(-low - inner) < 1e-9 && std::abs(high - inner) < 1e-9;
          REQUIRE((touchesX || touchesY));
        }
      }
    }
  }
}

TEST_CASE("views stand where their names say, and pictures are upright") {
  const std::vector<Vec3d> box{{-1, -1, -1}, {1, 1, 1}};
  CameraOptions options;
  options.view = *viewNamed("front");
  Camera camera = fitCamera(box, options);
  CHECK(camera.eye.y < -1);
  CHECK(camera.project({0.5, 0, 0}).x > 0);  // east is right of one who looks north
  CHECK(camera.project({0, 0, 0.5}).y > 0);
  options.view = *viewNamed("right");
  camera = fitCamera(box, options);
  CHECK(camera.eye.x > 1);
  CHECK(camera.project({0, 0.5, 0}).x > 0);
  options.view = *viewNamed("top");
  camera = fitCamera(box, options);
  CHECK(camera.eye.z > 1);
  CHECK(camera.project({0, 0.5, 0}).y > 0);  // north is up
  options.view = *viewNamed("front");
  options.up = UpAxis::y;
  camera = fitCamera(box, options);
  CHECK(camera.eye.z > 1);
  CHECK(camera.project({0, 0.5, 0}).y > 0);
  CHECK(camera.project({0.5, 0, 0}).x > 0);
  CHECK_FALSE(viewNamed("frnt"));
}

TEST_CASE("directions and places are inverse to each other") {
  const Camera camera = fitCamera(cloud({0, 0, 0}, 1), {});
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {0.9, -0.3}, {-1.0, 1.0}}) {
    const auto place = camera.project(camera.eye + camera.direction(x, y) * 3.0);
    CHECK(place.x == Approx(x).margin(1e-12));
    CHECK(place.y == Approx(y).margin(1e-12));
  }
}

TEST_CASE("single points can be looked at, nothing and bad options cannot") {
  const Camera camera = fitCamera(std::vector<Vec3d>{{1, 2, 3}}, {});
  CHECK(camera.project({1, 2, 3}).depth == Approx(1));
  CHECK_THROWS_AS(fitCamera({}, {}), Error);
  CHECK_THROWS_AS(fitCamera(std::vector<Vec3d>{{1, NAN, 3}}, {}), Error);
  CameraOptions options;
  options.fieldOfView = 180;
  CHECK_THROWS_AS(fitCamera(std::vector<Vec3d>{{1, 2, 3}}, options), Error);
}
