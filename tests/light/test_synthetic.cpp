// Lights in closed form.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "light/support.h"
#include "light/synthetic.h"

using namespace shbake;
using namespace shbake::testing;

namespace {
const Vec3d kWhite{1, 1, 1};
}

TEST_CASE("a disc of 180 degrees is constant light, one of 0 is black") {
  REQUIRE(maxDifference(discLight(8, {1, 2, 3}, 180, kWhite), constantLight(8, kWhite)) < 1e-14);
  REQUIRE(maxDifference(discLight(8, {1, 2, 3}, 0, kWhite), Light(8)) == 0);
}

TEST_CASE("a disc holds its solid angle and points to its direction") {
  const Vec3d d = randomDirection(1, 0);
  for (const double angle : {0.27, 30.0, 90.0, 150.0}) {
    const Light disc = discLight(6, d, angle, kWhite);
    const double c = std::cos(angle * kPi / 180), half = std::sin(angle * kPi / 360);
    REQUIRE(disc.coefficients[0].x * std::sqrt(4 * kPi) == Approx(4 * kPi * half * half).epsilon(1e-13));
    const Dominant found = dominantDirection(disc);
    REQUIRE(length(found.direction - d) < 1e-12);
    // systems of Hazel's normalised light: |R1| / R0 = (1 + cos t) / 2.
    REQUIRE(found.ratio == Approx((1 + c) / 2).epsilon(1e-12));
  }
}

TEST_CASE("discs of twice a radius differ by a ring: they agree with midpoint sums") {
  const double angle = 40;
  const Light disc = discLight(5, {0, 0, 1}, angle, kWhite);
  const double low = std::cos(angle * kPi / 180);
  const int steps = 2000;
  std::vector<double> sums(25), y(25);
  for (int i = 0; i < steps; ++i) {
    const double z = low + (1 - low) * (i + 0.5) / steps;
    sh::evaluate(5, Vec3d{std::sqrt(1 - z * z), 0, z}, y);
    for (int l = 0; l < 5; ++l) sums[sh::index(l, 0)] += 2 * kPi * y[sh::index(l, 0)] * (1 - low) / steps;
  }
  // Midpoints: (1 - low) h^2 / 24 times a second derivative of at most about 40.
  for (int i = 0; i < 25; ++i) REQUIRE(std::abs(disc.coefficients[i].x - sums[i]) < 1e-6);
}

TEST_CASE("directional light and discs of stated irradiance give it to a facing surface") {
  const Vec3d d = randomDirection(2, 0), e{3, 2, 1};
  for (const int order : {1, 2, 3, 4, 9, 32}) {
    REQUIRE(length(irradianceAt(directionalLight(order, d, e), d) - e) < 1e-12);
    for (const double angle : {0.0, 0.5, 20.0, 90.0}) {
      REQUIRE(length(irradianceAt(discLightOfIrradiance(order, d, angle, e), d) - e) < 1e-12);
    }
  }
  // Order 3: the sum over l of A_l (2l+1) / 4 pi is 17/16, the factor that Direct3D divides by.
  REQUIRE(directionalLight(3, d, kWhite).coefficients[0].x == Approx(16.0 / 17 / std::sqrt(4 * kPi)).epsilon(1e-14));
}

TEST_CASE("a ball of light is the disc that it covers") {
  const Light ball = sphereLight(4, {0, 3, 0}, 1.5, kWhite);
  REQUIRE(maxDifference(ball, discLight(4, {0, 1, 0}, 30, kWhite)) < 1e-14);
  REQUIRE_THROWS_AS(sphereLight(4, {0, 1, 0}, 1, kWhite), Error);
}

TEST_CASE("gradient light runs linearly with the cosine") {
  const Vec3d up = randomDirection(3, 0), top{1, 2, 3}, bottom{0.5, 0, 1};
  const Light light = gradientLight(4, up, top, bottom);
  REQUIRE(length(radianceFrom(light, up) - top) < 1e-14);
  REQUIRE(length(radianceFrom(light, -up) - bottom) < 1e-14);
  const Vec3d d = randomDirection(4, 0);
  const double share = (1 + dot(d, up)) / 2;
  REQUIRE(length(radianceFrom(light, d) - (bottom + (top - bottom) * share)) < 1e-14);
  REQUIRE(length(radianceFrom(gradientLight(1, up, top, bottom), d) - 0.5 * (top + bottom)) < 1e-15);
}

TEST_CASE("lights out of range are refused") {
  REQUIRE_THROWS_AS(discLight(3, {0, 0, 0}, 10, kWhite), Error);
  REQUIRE_THROWS_AS(discLight(3, {0, 0, 1}, -1, kWhite), Error);
  REQUIRE_THROWS_AS(discLight(3, {0, 0, 1}, 181, kWhite), Error);
  REQUIRE_THROWS_AS(discLight(0, {0, 0, 1}, 10, kWhite), Error);
  REQUIRE_THROWS_AS(discLight(129, {0, 0, 1}, 10, kWhite), Error);
  REQUIRE_THROWS_AS(discLightOfIrradiance(3, {0, 0, 1}, 91, kWhite), Error);
  REQUIRE_THROWS_AS(directionalLight(3, {NAN, 0, 1}, kWhite), Error);
  REQUIRE_THROWS_AS(constantLight(3, {INFINITY, 0, 0}), Error);
}
