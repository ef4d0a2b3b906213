// Conversions of convention, checked in absolute directions.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/conventions.h"
#include "sh/rotation.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("Condon-Shortley coefficients belong to the basis with phase (-1)^m") {
  auto c = randomCoefficients(6, 170);
  const auto before = c;
  flipCondonShortley(6, c);
  const Vec3d d = randomDirection(171, 0);
  // The phased basis written from the standard library's Legendre functions, which as sph_legendre carry (-1)^m.
  const double theta = std::acos(d.z), phi = std::atan2(d.y, d.x);
  double sum = 0;
  for (int i = 0; i < 36; ++i) {
    const int l = degreeOf(i), m = orderOf(i);
    const double p = std::sph_legendre(static_cast<unsigned>(l), static_cast<unsigned>(std::abs(m)), theta);
    const double azimuth = m == 0 ? 1 : std::numbers::sqrt2 * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
    sum += c[i] * p * azimuth;
  }
  REQUIRE(std::abs(sum - valueAt(6, before, d)) < 1e-13);
  flipCondonShortley(6, c);
  REQUIRE(c == before);
}

TEST_CASE("a Condon-Shortley mismatch is half a turn about z, which no symmetric test shows") {
  auto phased = randomCoefficients(5, 172);
  std::vector<double> turned(25);
  Rotation(5, rotationAboutZ(kPi)).apply(phased, turned);
  flipCondonShortley(5, phased);
  REQUIRE(maxDifference(phased, turned) < 1e-14);
  std::vector<double> fromX = basisAt(2, {1, 0, 0});
  flipCondonShortley(2, fromX);
  REQUIRE(valueAt(2, fromX, {1, 0, 0}) < valueAt(2, fromX, {-1, 0, 0}));
}

TEST_CASE("geodesy's basis has mean square 1 and no phase") {
  // Y_11 of that basis is sqrt(3) x.
  std::vector<double> c(4);
  c[3] = 1;
  toGeodesy(2, c);
  const Vec3d d = randomDirection(173, 0);
  REQUIRE(c[3] * std::sqrt(3.0) * d.x == Approx(basisAt(2, d)[3]).epsilon(1e-14));
  REQUIRE(c[3] > 0);
  auto many = randomCoefficients(4, 174);
  const auto before = many;
  toGeodesy(4, many);
  fromGeodesy(4, many);
  REQUIRE(maxDifference(many, before) < 1e-15);
  // A constant's coefficient is the constant.
  std::vector<double> white{std::sqrt(4 * kPi)};
  toGeodesy(1, white);
  REQUIRE(white[0] == Approx(1).epsilon(1e-15));
}

TEST_CASE("y-up axes: what came from +z comes from +y, what came from +y from -z, x stays") {
  for (const int order : {1, 2, 5, 33}) {
    const auto before = randomCoefficients(order, 175);
    auto c = before;
    toYUp(order, c);
    for (int i = 0; i < 10; ++i) {
      const Vec3d d = randomDirection(176, i);
      REQUIRE(std::abs(valueAt(order, c, {d.x, d.z, -d.y}) - valueAt(order, before, d)) < 1e-14 * order * 3);
    }
    fromYUp(order, c);
    REQUIRE(maxDifference(c, before) < 1e-14);
  }
  std::vector<double> fromAbove{0, 0, 1, 0};
  toYUp(2, fromAbove);
  REQUIRE(maxDifference(fromAbove, std::vector<double>{0, 1, 0, 0}) < 1e-15);
}

TEST_CASE("conversions refuse arrays that are too short") {
  std::vector<double> eight(8);
  REQUIRE_THROWS_AS(flipCondonShortley(3, eight), Error);
  REQUIRE_THROWS_AS(toGeodesy(3, eight), Error);
  REQUIRE_THROWS_AS(fromGeodesy(3, eight), Error);
  REQUIRE_THROWS_AS(toYUp(3, eight), Error);
  REQUIRE_THROWS_AS(fromYUp(3, eight), Error);
  REQUIRE_THROWS_AS(toYUp(0, eight), Error);
}
