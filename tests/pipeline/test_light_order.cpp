// How many bands a light needs: closed forms for what is not shadowed, and pictures that lack what is said.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "light/synthetic.h"
#include "pipeline/light_order.h"
#include "sh/irradiance.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

LightingPoints pointsOf(const Mesh& mesh, Rgb albedo = {1, 1, 1}) {
  Progress progress;
  return makeLightingPoints(mesh, {}, {Albedo::Per::mesh, {albedo}}, progress);
}

LightOrder choose(const LightingPoints& points, TransferKind kind, const Light& light, double tolerance,
                  int threads = 1) {
  BakeOptions options;
  options.kind = kind;
  const Parallel parallel(threads);
  Progress progress;
  TracedPoints traced(points, parallel, progress);
  return chooseOrder(traced, {}, options, light, tolerance, parallel, progress);
}

/// A light with |L_l|^2 = `energies[l]` in each channel.
Light lightOf(const std::array<double, 8>& energies) {
  Light light(8);
  for (std::size_t l = 0; l < 8; ++l) {
    for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) {
      const double value = std::sqrt(energies[l] / double(2 * l + 1));
      light.coefficients[i] = {value, value, value};
    }
  }
  return light;
}

}  // namespace

TEST_CASE("open surfaces need the bands of light that a cosine lets through", "[light_order]") {
  const LightingPoints points = pointsOf(shapes::icosphere(2));
  const std::array<double, 8> energies{1, 1, 1, 1, 1, 1, 1, 1};
  // |t_l|^2 = A_l^2 (2l + 1) / 4 pi, so that each band brings |L_l|^2 A_l^2 / 4 pi.
  std::array<double, 8> brings{};
  double total = 0;
  for (int l = 0; l < 8; ++l) total += brings[std::size_t(l)] = std::pow(sh::cosineLobe(l), 2);
  const LightOrder found = choose(points, TransferKind::unshadowed, lightOf(energies), 0.05);
  double tail = total;
  for (std::size_t n = 1; n <= 8; ++n) {
    tail -= brings[n - 1];
    INFO("order " << n);
    CHECK(found.left[n - 1] == Approx(std::sqrt(std::max(0.0, tail) / total)).margin(1e-5));
  }
  // With three bands 3.4 % are lacking, with five 1.3 %, with two 21 %.
  CHECK(found.order == 3);
  CHECK(choose(points, TransferKind::unshadowed, lightOf(energies), 0.02).order == 5);
  CHECK(choose(points, TransferKind::unshadowed, lightOf(energies), 0.22).order == 2);
  CHECK(choose(points, TransferKind::unshadowed, lightOf(energies), 1e-4).order > 5);
}

TEST_CASE("a light that is even needs one band, and a black one", "[light_order]") {
  const LightingPoints points = pointsOf(shapes::city(2, 1, 2), {0.8f, 0.4f, 0.1f});
  CHECK(choose(points, TransferKind::interreflected, constantLight(8, {1, 2, 3}), 1e-4).order == 1);
  CHECK(choose(points, TransferKind::shadowed, Light(8), 1e-4).order == 1);
}

TEST_CASE("a light of few bands needs no more, a sun all", "[light_order]") {
  const LightingPoints points = pointsOf(shapes::city(2, 1, 2));
  const LightOrder few = choose(points, TransferKind::shadowed, lightOf({4, 2, 1, 0, 0, 0, 0, 0}), 1e-4);
  CHECK(few.order == 3);
  CHECK(few.left[2] == 0);
  CHECK(few.left[1] > 0.01);
  const LightOrder sun = choose(points, TransferKind::shadowed, discLight(8, {0, 0, 1}, 0.3, {1, 1, 1}), 1e-3);
  CHECK(sun.order == 8);
  for (std::size_t n = 1; n < 8; ++n) CHECK(sun.left[n] <= sun.left[n - 1]);
}

TEST_CASE("each channel's light meets its own transfer", "[light_order]") {
  // Red light has many bands, but nothing reflects red.
  Light light = lightOf({1, 1, 1, 1, 1, 1, 1, 1});
  for (std::size_t i = 4; i < light.coefficients.size(); ++i) light.coefficients[i].y = light.coefficients[i].z = 0;
  const Mesh mesh = shapes::city(2, 1, 2);
  CHECK(choose(pointsOf(mesh, {0, 0.5f, 0.7f}), TransferKind::shadowed, light, 1e-3).order == 2);
  CHECK(choose(pointsOf(mesh, {0.5f, 0.5f, 0.5f}), TransferKind::shadowed, light, 1e-3).order > 2);
}

TEST_CASE("the order does not depend on threads", "[light_order]") {
  const LightingPoints points = pointsOf(shapes::city(3, 1, 2));
  const Light light = lightOf({1, 1, 1, 1, 1, 1, 1, 1});
  CHECK(choose(points, TransferKind::shadowed, light, 0.01, 1).left ==
        choose(points, TransferKind::shadowed, light, 0.01, 3).left);
}
