// Discs of shadow multiplied into light.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "light/proxy_shadow.h"
#include "light/support.h"
#include "light/synthetic.h"

using namespace shbake;
using namespace shbake::testing;

TEST_CASE("a shadow of 180 degrees leaves nothing, one of 0 everything") {
  const Light light = randomLight(5, 1);
  REQUIRE(maxDifference(withProxyShadow(light, {1, 2, 3}, 180, 5), Light(5)) < 1e-14);
  REQUIRE(maxDifference(withProxyShadow(light, {1, 2, 3}, 0, 5), light) < 1e-13);
}

TEST_CASE("the shadow on even light is the complement of a disc") {
  const Vec3d d = randomDirection(2, 0), white{1, 1, 1};
  for (const double angle : {10.0, 60.0, 120.0}) {
    Light expected = constantLight(8, white);
    addLight(expected, discLight(8, d, angle, white), {-1, -1, -1});
    REQUIRE(maxDifference(withProxyShadow(constantLight(8, white), d, angle, 8), expected) < 1e-13);
  }
}

TEST_CASE("a shadowed light agrees with sums over the directions outside the disc") {
  // Polar midpoints about the disc's axis, so that its edge lies between them: only the smooth parts err, with h^2 / 24
  // times second derivatives of the product of two functions of degree below 6.
  const int order = 6, output = 4, steps = 600;
  const Light light = randomLight(order, 3);
  const double angle = 35 * kPi / 180;
  const Light shadowed = withProxyShadow(light, {0, 0, 1}, 35, output);
  const auto midpoints = [&](int n) {
    Light sum(output);
    std::vector<double> y(sum.coefficients.size());
    for (int i = 0; i < n; ++i) {
      const double z = -1 + (1 + std::cos(angle)) * (i + 0.5) / n, r = std::sqrt(1 - z * z);
      for (int k = 0; k < 16; ++k) {  // 16 equal steps are exact for degrees below 16
        const double phi = 2 * kPi * (k + 0.5) / 16;
        const Vec3d d{r * std::cos(phi), r * std::sin(phi), z};
        const Vec3d value = radianceFrom(light, d) * ((1 + std::cos(angle)) / n * 2 * kPi / 16);
        sh::evaluate(output, d, y);
        for (std::size_t j = 0; j < y.size(); ++j) sum.coefficients[j] += value * y[j];
      }
    }
    return sum;
  };
  const double coarse = maxDifference(midpoints(steps / 2), shadowed), fine = maxDifference(midpoints(steps), shadowed);
  REQUIRE(fine < 1e-4);
  REQUIRE(fine == Approx(coarse / 4).epsilon(0.02));  // second order: the exact value is the limit
}

TEST_CASE("a shadow turns with its direction") {
  const Light light = randomLight(6, 4);
  const sh::Matrix3d turn = sh::rotationAbout({1, 1, -2}, 0.8);
  const Vec3d d = randomDirection(5, 0);
  const Light a = rotated(withProxyShadow(light, d, 50, 4), turn);
  const Light b = withProxyShadow(rotated(light, turn), turn * d, 50, 4);
  REQUIRE(maxDifference(a, b) < 1e-13);
}

TEST_CASE("light cut to the output's order before the shadow errs, light kept to a higher order does not") {
  const Vec3d d{0.2, -0.5, 0.7};
  const Light full = randomLight(8, 6), exact = withProxyShadow(full, d, 40, 4);
  REQUIRE(maxDifference(withProxyShadow(withOrder(full, 4), d, 40, 4), exact) > 0.02);
  REQUIRE(maxDifference(withProxyShadow(withOrder(full, 12), d, 40, 4), exact) < 1e-13);
}

TEST_CASE("shadows out of range are refused") {
  const Light light(3);
  REQUIRE_THROWS_AS(withProxyShadow(light, {0, 0, 1}, -1, 3), Error);
  REQUIRE_THROWS_AS(withProxyShadow(light, {0, 0, 1}, 200, 3), Error);
  REQUIRE_THROWS_AS(withProxyShadow(light, {0, 0, 0}, 20, 3), Error);
  REQUIRE_THROWS_AS(withProxyShadow(light, {0, 0, 1}, 20, 4), Error);
  REQUIRE_THROWS_AS(withProxyShadow(light, {0, 0, 1}, 20, 0), Error);
}
