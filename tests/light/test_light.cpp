// Operations on lights.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "light/light.h"
#include "light/support.h"
#include "light/synthetic.h"
#include "sh/matrix3.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

double distance(const Vec3d& a, const Vec3d& b) {
  return length(a - b);
}

}  // namespace

TEST_CASE("lights add with weights and keep the higher order") {
  Light sum = randomLight(2, 1);
  const Light before = sum, other = randomLight(4, 2);
  addLight(sum, other, {1, 2, -3});
  REQUIRE(sum.order == 4);
  const Vec3d d = randomDirection(3, 0), a = radianceFrom(before, d), b = radianceFrom(other, d);
  REQUIRE(distance(radianceFrom(sum, d), {a.x + b.x, a.y + 2 * b.y, a.z - 3 * b.z}) < 1e-14);
  Light low = other;
  addLight(low, before);
  REQUIRE(low.order == 4);
}

TEST_CASE("turning a light turns what it shows") {
  const Light light = randomLight(6, 4);
  const sh::Matrix3d turn = sh::rotationAbout({1, -2, 0.5}, 1.2);
  const Light result = rotated(light, turn);
  for (int i = 0; i < 20; ++i) {
    const Vec3d d = randomDirection(5, i);
    REQUIRE(distance(radianceFrom(result, turn * d), radianceFrom(light, d)) < 1e-13);
  }
}

TEST_CASE("mirroring a light mirrors what it shows") {
  const Light light = randomLight(6, 6);
  for (int i = 0; i < 20; ++i) {
    const Vec3d d = randomDirection(7, i), value = radianceFrom(light, d);
    REQUIRE(distance(radianceFrom(mirrored(light, MirrorAxis::x), {-d.x, d.y, d.z}), value) < 1e-13);
    REQUIRE(distance(radianceFrom(mirrored(light, MirrorAxis::y), {d.x, -d.y, d.z}), value) < 1e-13);
    REQUIRE(distance(radianceFrom(mirrored(light, MirrorAxis::z), {d.x, d.y, -d.z}), value) < 1e-13);
  }
}

TEST_CASE("a light's order can be changed and its channels read and set") {
  const Light light = randomLight(3, 8);
  REQUIRE(maxDifference(withOrder(withOrder(light, 5), 3), light) == 0);
  REQUIRE(withOrder(light, 5).coefficients[20] == Vec3d{});
  REQUIRE(withOrder(light, 1).coefficients.size() == 1);
  Light copy(3);
  for (int c = 0; c < 3; ++c) copy.setChannel(c, light.channel(c));
  REQUIRE(sameBits(copy, light));
}

TEST_CASE("a constant light of radiance 1 gives irradiance pi and has no direction") {
  Light light(3);
  light.coefficients[0] = Vec3d{1, 1, 1} * std::sqrt(4 * kPi);
  REQUIRE(distance(irradianceAt(light, randomDirection(9, 1)), Vec3d{1, 1, 1} * kPi) < 1e-14);
  REQUIRE(dominantDirection(light).ratio == 0);
  REQUIRE(dominantDirection(Light(3)).ratio == 0);
  REQUIRE(dominantDirection(Light(1)).ratio == 0);
}

TEST_CASE("band energies sum to the light's squared norm") {
  const Light light = randomLight(5, 10);
  Vec3d total, expected;
  for (const Vec3d& e : bandEnergies(light)) total += e;
  for (const Vec3d& c : light.coefficients) expected += {c.x * c.x, c.y * c.y, c.z * c.z};
  REQUIRE(distance(total, expected) < 1e-13);
  REQUIRE(bandEnergies(light)[0].x == light.coefficients[0].x * light.coefficients[0].x);
}

TEST_CASE("the linear band points to the light, its ratio is 1 for one direction") {
  const Vec3d d = randomDirection(11, 2);
  std::vector<double> y(16);
  sh::evaluate(4, d, y);
  Light light(4);
  for (std::size_t i = 0; i < y.size(); ++i) light.coefficients[i] = Vec3d{2, 1, 0.5} * y[i];
  const Dominant found = dominantDirection(light);
  REQUIRE(distance(found.direction, d) < 1e-14);
  REQUIRE(found.ratio == Approx(1).epsilon(1e-14));
}

TEST_CASE("lights of impossible orders or values are refused") {
  REQUIRE_THROWS_AS(Light(0), Error);
  REQUIRE_THROWS_AS(Light(kMaxLightOrder + 1), Error);
  REQUIRE_THROWS_AS(Light(2, std::vector<Vec3d>(3)), Error);
  REQUIRE_THROWS_AS(Light(1, {{NAN, 0, 0}}), Error);
  REQUIRE_THROWS_AS(withOrder(Light(1), 0), Error);
  REQUIRE_NOTHROW(Light(kMaxLightOrder));
}

TEST_CASE("lights are windowed together, by the least window that all need") {
  std::vector<Light> lights{directionalLight(5, {0, 0, 1}, {1, 1, 1}), constantLight(5, {1, 2, 3}),
                            discLight(5, {1, 0, 0}, 20, {1, 0, 2})};
  std::vector<Light> alone{lights[0]};
  const double strongest = applyWindow(sh::Window::automatic, alone);
  const std::vector<Light> before = lights;
  CHECK(applyWindow(sh::Window::automatic, lights) == strongest);
  const std::vector<double> factors = sh::laplacianFactors(strongest, 5);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    for (int i = 0; i < 25; ++i) {
      const Vec3d expected = before[k].coefficients[i] * factors[sh::degreeOf(i)];
      REQUIRE(distance(lights[k].coefficients[i], expected) < 1e-15);
    }
    for (int i = 0; i < 300; ++i) REQUIRE(radianceFrom(lights[k], randomDirection(9, i)).x > -1e-9);
  }
  CHECK(applyWindow(sh::Window::hann, lights) == 0);
  lights[1] = constantLight(4, {1, 1, 1});
  CHECK_THROWS_AS(applyWindow(sh::Window::hann, lights), Error);
  CHECK(applyWindow(sh::Window::none, lights) == 0);
}
