// Range of a function given by coefficients.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/extremes.h"
#include "sh/green_light.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("the range of a linear function is known in closed form") {
  for (int trial = 0; trial < 20; ++trial) {
    auto c = randomCoefficients(2, 100 + trial);
    const Range range = valueRange(2, c);
    const double mean = c[0] / std::sqrt(4 * kPi), slope = std::hypot(c[1], c[2], c[3]) * std::sqrt(3 / (4 * kPi));
    REQUIRE(std::abs(range.min.value - (mean - slope)) < 1e-12);
    REQUIRE(std::abs(range.max.value - (mean + slope)) < 1e-12);
    const Vec3d towards = normalized(Vec3d{c[3], c[1], c[2]});
    REQUIRE(length(range.max.direction - towards) < 1e-6);
    REQUIRE(length(range.min.direction + towards) < 1e-6);
  }
}

TEST_CASE("a zonal lobe about any axis has its extremes on the axis and on a circle") {
  // y_20 turned to d has its maximum sqrt(5/4pi) at +-d and its minimum -sqrt(5/4pi)/2 on the circle around.
  const double peak = std::sqrt(5 / (4 * kPi));
  const std::vector<double> zonal{0, 0, 1};
  for (const Vec3d& d : {Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, randomDirection(101, 0)}) {
    std::vector<double> c(9);
    rotateZonal(zonal, d, c);
    const Range range = valueRange(3, c);
    REQUIRE(std::abs(range.max.value - peak) < 1e-12);
    REQUIRE(std::abs(range.min.value + peak / 2) < 1e-12);
    REQUIRE(std::abs(std::abs(dot(range.max.direction, d)) - 1) < 1e-10);
    REQUIRE(std::abs(dot(range.min.direction, d)) < 1e-5);
  }
}

TEST_CASE("no value of random functions lies outside the range, refined extremes are stationary") {
  for (const int order : {1, 3, 5, 9, 16}) {
    const auto c = randomCoefficients(order, 102);
    const Range range = valueRange(order, c);
    const double span = range.max.value - range.min.value;
    REQUIRE(valueAt(order, c, range.min.direction) == Approx(range.min.value).margin(1e-12 * (1 + span)));
    for (int i = 0; i < 4000; ++i) {
      const double v = valueAt(order, c, randomDirection(103, i));
      REQUIRE(v >= range.min.value - 1e-12 * (1 + span));
      REQUIRE(v <= range.max.value + 1e-12 * (1 + span));
    }
    REQUIRE(range.uncertainty <= 0.05 * span + 1e-15);
  }
}

TEST_CASE("extremes close to the found ones are not lower: a fine local search finds nothing") {
  const int order = 9;
  const auto c = randomCoefficients(order, 104);
  const Range range = valueRange(order, c);
  for (int i = 0; i < 2000; ++i) {
    const double scale = std::pow(10.0, -6 * hashUnit(105, i));
    const Vec3d d = normalized(range.min.direction + randomDirection(106, i) * scale);
    REQUIRE(valueAt(order, c, d) >= range.min.value - 1e-12);
  }
}

TEST_CASE("a flat minimum, of fourth order, is found too") {
  // (1 - d.a)^2 = 4/3 - 2 P_1 + 2/3 P_2 of the cosine: 0 at a and 4 opposite.
  const Vec3d axis = randomDirection(108, 0);
  const std::vector<double> zonal{4.0 / 3 * std::sqrt(4 * kPi), -2 * std::sqrt(4 * kPi / 3),
                                  2.0 / 3 * std::sqrt(4 * kPi / 5)};
  std::vector<double> c(9);
  rotateZonal(zonal, axis, c);
  const Range range = valueRange(3, c);
  REQUIRE(std::abs(range.min.value) < 1e-12);
  REQUIRE(std::abs(range.max.value - 4) < 1e-12);
}

TEST_CASE("Green's light at order 4 rings to -0.1844 and peaks at 0.684") {
  const Range range = valueRange(4, greenCoefficients(4));
  REQUIRE(std::abs(range.min.value + 0.1844) < 5e-5);
  REQUIRE(std::abs(range.max.value - 0.684) < 5e-4);
}

TEST_CASE("staysAbove decides on either side of the least value") {
  for (const int order : {2, 4, 9}) {
    const auto c = randomCoefficients(order, 107);
    const double least = valueRange(order, c).min.value;
    REQUIRE(staysAbove(order, c, least - 1e-10));
    REQUIRE_FALSE(staysAbove(order, c, least + 1e-10));
    REQUIRE(staysAbove(order, c, least - 100));
    REQUIRE_FALSE(staysAbove(order, c, least + 0.1));
  }
}

TEST_CASE("constant and zero functions have a range of one value") {
  for (const double value : {0.0, 2.5, -1.0}) {
    std::vector<double> c(16);
    c[0] = value * std::sqrt(4 * kPi);
    const Range range = valueRange(4, c);
    REQUIRE(range.min.value == Approx(value).margin(1e-15));
    REQUIRE(range.max.value == Approx(value).margin(1e-15));
  }
}

TEST_CASE("what is not finite or too short is refused") {
  std::vector<double> c(9);
  REQUIRE_THROWS_AS(valueRange(4, c), Error);
  REQUIRE_THROWS_AS(valueRange(0, c), Error);
  c[5] = NAN;
  REQUIRE_THROWS_AS(valueRange(3, c), Error);
  REQUIRE_THROWS_AS(staysAbove(3, c, 0), Error);
}
