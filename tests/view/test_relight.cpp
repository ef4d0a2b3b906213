// Relit colours against double sums and closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/hash.h"
#include "light/synthetic.h"
#include "sh/irradiance.h"
#include "view/exposure.h"
#include "view/relight.h"
#include "view/vertex_areas.h"

using namespace shbake;

namespace {

double signedUnit(std::uint64_t seed, std::uint64_t index) {
  return 2 * hashUnit(seed, index) - 1;
}

TransferSet randomTransfer(int order, int channels, std::size_t points) {
  TransferSet set;
  set.order = order;
  set.channels = channels;
  for (std::size_t i = 0; i < points * set.stride(); ++i) {
    set.coefficients.push_back(static_cast<float>(signedUnit(1, i)));
  }
  return set;
}

Light randomLight(int order, std::uint64_t seed) {
  Light light(order);
  for (std::size_t i = 0; i < light.coefficients.size(); ++i) {
    light.coefficients[i] = {signedUnit(seed, 3 * i), signedUnit(seed, 3 * i + 1), signedUnit(seed, 3 * i + 2)};
  }
  return light;
}

double component(const Vec3d& v, int c) {
  return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

/// Open points of albedo 1 with these normals.
TransferSet openTransfer(int order, const std::vector<Vec3d>& normals) {
  TransferSet set;
  set.order = order;
  std::vector<double> row(static_cast<std::size_t>(order * order));
  for (const Vec3d& n : normals) {
    sh::unshadowedTransfer(order, n, 1.0, row);
    for (const double t : row) set.coefficients.push_back(static_cast<float>(t));
  }
  return set;
}

std::vector<Vec3d> someDirections(std::size_t count) {
  std::vector<Vec3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    directions.push_back(normalized(Vec3d{signedUnit(7, 3 * i), signedUnit(7, 3 * i + 1), signedUnit(7, 3 * i + 2)}));
  }
  return directions;
}

}  // namespace

TEST_CASE("relit colours are the double sum over common bands, to the stated rounding") {
  const Parallel parallel(2);
  for (const int channels : {1, 3}) {
    for (const auto& [order, lightOrder] : {std::pair(1, 1), {2, 2}, {3, 5}, {4, 4}, {5, 3}, {5, 5}, {6, 6}, {7, 2}}) {
      const TransferSet set = randomTransfer(order, channels, 5000);
      const Light light = randomLight(lightOrder, 2);
      const std::vector<Rgb> colors = relight(set, light, {}, parallel);
      const std::size_t terms = static_cast<std::size_t>(std::min(order, lightOrder) * std::min(order, lightOrder));
      double worst = 0;
      for (std::size_t p = 0; p < set.size(); ++p) {
        for (int c = 0; c < 3; ++c) {
          const auto t = set.at(p, channels == 3 ? c : 0);
          double sum = 0, magnitude = 0;
          for (std::size_t i = 0; i < terms; ++i) {
            const double term = static_cast<double>(t[i]) * component(light.coefficients[i], c);
            sum += term;
            magnitude += std::abs(term);
          }
          worst = std::max(worst, std::abs(component(Vec3d(colors[p]), c) - sum) / magnitude);
        }
      }
      INFO("order " << order << " light " << lightOrder << " channels " << channels);
      CHECK(worst <= (static_cast<double>(terms) / 8 + 6) * 0x1p-24);
      CHECK(worst > 0);
    }
  }
}

TEST_CASE("relighting is linear in the light, to rounding") {
  const Parallel parallel(2);
  const TransferSet set = randomTransfer(4, 3, 3000);
  const Light a = randomLight(4, 3), b = randomLight(4, 4);
  Light sum = scaled(a, {2, 2, 2});
  addLight(sum, b, {-3, -3, -3});
  const auto ca = relight(set, a, {}, parallel), cb = relight(set, b, {}, parallel);
  const auto cs = relight(set, sum, {}, parallel);
  // Sixteen terms of at most 5 in three sums: 3 * 8 * 2^-24 * 16 * 5.
  for (std::size_t p = 0; p < cs.size(); ++p) REQUIRE(length(cs[p] - (ca[p] * 2.f - cb[p] * 3.f)) < 1.2e-4f);
}

TEST_CASE("a white furnace gives every open point its albedo") {
  const Parallel parallel(2);
  const TransferSet set = openTransfer(5, someDirections(500));
  for (const Rgb& c : relight(set, constantLight(5, {1, 0.5, 0.25}), {}, parallel)) {
    REQUIRE(std::abs(c.x - 1) < 1e-6);
    REQUIRE(std::abs(c.y - 0.5) < 1e-6);
    REQUIRE(std::abs(c.z - 0.25) < 1e-6);
  }
}

TEST_CASE("turning the light is turning the normals the other way") {
  const Parallel parallel(2);
  const sh::Matrix3d turn = sh::rotationAbout({1, -2, 0.5}, 0.8);
  std::vector<Vec3d> normals = someDirections(200), turned;
  for (const Vec3d& n : normals) turned.push_back(turn * n);
  const Light light = randomLight(5, 5);
  const auto before = relight(openTransfer(5, normals), light, {}, parallel);
  const auto after = relight(openTransfer(5, turned), rotated(light, turn), {}, parallel);
  // Coefficients of the transfer and the sums are single precision; 25 terms of at most 1.
  for (std::size_t p = 0; p < before.size(); ++p) REQUIRE(length(before[p] - after[p]) < 1e-5f);
}

TEST_CASE("colours do not depend on threads") {
  const TransferSet set = randomTransfer(5, 3, 20000);
  const Light light = randomLight(5, 6);
  const auto one = relight(set, light, {}, Parallel(1));
  CHECK(relight(set, light, {}, Parallel(3)) == one);
}

TEST_CASE("the audit finds where a directional light of order 2 rings, and how much") {
  // E cosine-clamped at order 2 is E (1/4 + cos/2): negative where the cosine is below -1/2, a quarter of the sphere
  // (Ramamoorthi and Hanrahan 2001). An octahedron's corner at -z has -1/4, the others 1/4 and +z has 3/4.
  const std::vector<Vec3d> corners{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  Mesh mesh;
  mesh.positions = corners;
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  Light light(2);
  const double pi = std::numbers::pi;
  light.coefficients[0] = Vec3d{1, 1, 1} * (pi / std::sqrt(4 * pi));
  light.coefficients[2] = Vec3d{1, 1, 1} * (pi * std::sqrt(3 / (4 * pi)));
  const TransferSet set = openTransfer(2, corners);
  const auto colors = relight(set, light, {}, Parallel(1));
  const NegativeAudit audit = auditNegatives(mesh, colors);
  CHECK(audit.worstVertex == 5);
  CHECK(audit.worst == Approx(-0.25).epsilon(1e-6));
  CHECK(audit.worstShare == Approx(1.0 / 3).epsilon(1e-6));
  CHECK(audit.areaShare == Approx(1.0 / 6).epsilon(1e-12));

  const NegativeAudit clamped = auditNegatives(mesh, relight(set, light, {.clampNegative = true}, Parallel(1)));
  CHECK(clamped.worst == 0);
  CHECK(clamped.areaShare == 0);
  const auto windowed = relight(set, light, {.window = sh::Window::automatic}, Parallel(1));
  CHECK(auditNegatives(mesh, windowed).worst == 0);
  CHECK(windowed[0].x == Approx(0.25).epsilon(1e-6));  // a window leaves the mean
  CHECK_THROWS_AS(auditNegatives(mesh, std::vector<Rgb>(5)), Error);
}

TEST_CASE("a window acts at the order that is used") {
  const Light light = randomLight(6, 8);
  const Light used = usedLight(light, 3, sh::Window::hann);
  REQUIRE(used.order == 3);
  for (int i = 0; i < 9; ++i) {
    const int l = i == 0 ? 0 : i < 4 ? 1 : 2;
    const double factor = (1 + std::cos(std::numbers::pi * l / 3)) / 2;
    CHECK(used.coefficients[i].y == Approx(light.coefficients[i].y * factor).margin(1e-15));
  }
}

TEST_CASE("transfers of the wrong shape are refused") {
  TransferSet set = randomTransfer(3, 1, 4);
  set.coefficients.pop_back();
  CHECK_THROWS_AS(relight(set, Light(3), {}, Parallel(1)), Error);
}

TEST_CASE("automatic exposure takes the radiance that 99 % of the area stays below to 0.9") {
  std::vector<Rgb> colors(200, Rgb(0.3f, 0.6f, 0.1f));
  colors[7] = {50, 50, 50};
  const std::vector<double> even(200, 0.5);
  CHECK(automaticExposure(colors, even) == Approx(std::log2(0.9 / 0.6)).epsilon(1e-6));
  std::vector<double> uneven = even;
  uneven[7] = 2;
  CHECK(automaticExposure(colors, uneven) == Approx(std::log2(0.9 / 50)).epsilon(1e-6));
  CHECK(automaticExposure(std::vector<Rgb>(3), std::vector<double>(3, 1.0)) == 0);
}

TEST_CASE("under a rig each point has the blend of what its samples give") {
  const Parallel parallel(2);
  std::vector<LightSample> samples;
  for (std::uint64_t i = 0; i < 7; ++i) {
    samples.push_back(
        {Vec3d{signedUnit(30, 3 * i), signedUnit(30, 3 * i + 1), signedUnit(30, 3 * i + 2)}, randomLight(4, 40 + i)});
  }
  for (const RigMethod method : {RigMethod::inverseDistance, RigMethod::barycentric}) {
    const LightRig rig(samples, {method, 2});
    for (const int channels : {1, 3}) {
      const TransferSet set = randomTransfer(4, channels, 400);
      std::vector<Vec3d> places;
      for (std::uint64_t p = 0; p < 400; ++p) {
        places.push_back({2 * signedUnit(31, 3 * p), 2 * signedUnit(31, 3 * p + 1), 2 * signedUnit(31, 3 * p + 2)});
      }
      const std::vector<Rgb> colors = relight(set, places, rig, {}, parallel);
      for (std::size_t p = 0; p < set.size(); ++p) {
        const Light light = rig.at(places[p]);
        for (int c = 0; c < 3; ++c) {
          const auto t = set.at(p, channels == 3 ? c : 0);
          double sum = 0;
          for (std::size_t i = 0; i < 16; ++i) sum += static_cast<double>(t[i]) * component(light.coefficients[i], c);
          // 16 terms of at most 1, each sum to (16 / 8 + 6) 2^-24 of them, blended by weights that sum to 1.
          REQUIRE(std::abs(component(Vec3d(colors[p]), c) - sum) < (16.0 / 8 + 8) * 0x1p-24 * 16);
        }
      }
      CHECK_THROWS_AS(relight(set, std::vector<Vec3d>(3), rig, {}, parallel), Error);
    }
  }
  // One sample is distant light.
  const LightRig one({samples[0]}, {});
  const TransferSet set = randomTransfer(5, 3, 50);
  const std::vector<Vec3d> places(50, Vec3d{1, 2, 3});
  const RelightOptions window{sh::Window::hann, true};
  CHECK(relight(set, places, one, window, parallel) == relight(set, samples[0].light, window, parallel));
}
