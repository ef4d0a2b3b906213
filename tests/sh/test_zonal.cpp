// Zonal functions: turning, convolution, projection of profiles, caps.
#include <array>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/irradiance.h"
#include "sh/rotation.h"
#include "sh/support.h"
#include "sh/zonal.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

namespace {

std::vector<double> alongZ(const std::vector<double>& zonal) {
  std::vector<double> c(zonal.size() * zonal.size());
  for (std::size_t l = 0; l < zonal.size(); ++l) c[index(static_cast<int>(l), 0)] = zonal[l];
  return c;
}

std::vector<double> randomZonal(int order, std::uint64_t seed) {
  std::vector<double> z(order);
  for (int l = 0; l < order; ++l) z[l] = 2 * hashUnit(seed, l) - 1;
  return z;
}

}  // namespace

TEST_CASE("turning a zonal function equals rotating its coefficients") {
  for (const int order : {1, 4, 9, 33}) {
    const auto zonal = randomZonal(order, 130);
    for (int trial = 0; trial < 5; ++trial) {
      const Vec3d d = randomDirection(131, trial);
      std::vector<double> direct(coefficientCount(order)), rotated(direct.size());
      rotateZonal(zonal, d, direct);
      const Matrix3d r = rotationAbout(cross(Vec3d{0, 0, 1}, d), angleBetween(Vec3d{0, 0, 1}, d));
      Rotation(order, r).apply(alongZ(zonal), rotated);
      REQUIRE(maxDifference(direct, rotated) < 1e-13);
    }
  }
}

TEST_CASE("the value of a turned zonal function is its profile at the angle to the axis") {
  const int order = 9;
  const auto zonal = randomZonal(order, 132);
  const Vec3d axis = randomDirection(133, 0), d = randomDirection(133, 1);
  std::vector<double> c(coefficientCount(order));
  rotateZonal(zonal, axis, c);
  const double u = dot(axis, d);
  const Vec3d same{std::sqrt(1 - u * u), 0, u};
  REQUIRE(std::abs(valueAt(order, c, d) - valueAt(order, alongZ(zonal), same)) < 1e-13);
}

TEST_CASE("convolution with the clamped cosine is irradiance") {
  const int order = 6;
  const std::array<double, 1> kink{0};
  const auto cosine = projectZonal(
      order, [](double u) { return std::max(0.0, u); }, kink, 8);
  const auto light = randomCoefficients(order, 134);
  std::vector<double> convolved(light.size()), byLobe(light.size());
  convolve(cosine, light, convolved);
  irradiance(order, light, byLobe);
  REQUIRE(maxDifference(convolved, byLobe) < 1e-14);
}

TEST_CASE("convolution of two zonal functions commutes, and a narrow cap changes nothing but the scale") {
  const int order = 5;
  const auto a = randomZonal(order, 135), b = randomZonal(order, 136);
  std::vector<double> ab(25), ba(25);
  convolve(a, alongZ(b), ab);
  convolve(b, alongZ(a), ba);
  REQUIRE(maxDifference(ab, ba) < 1e-15);
  const double angle = 1e-4;
  auto cap = zonalCap(order, angle);
  const double area = kPi * angle * angle;
  const auto c = randomCoefficients(order, 137);
  std::vector<double> smoothed(25);
  convolve(cap, c, smoothed);
  // A cap damps degree l by l(l+1) angle^2 / 8 and has area pi angle^2 (1 - angle^2 / 12).
  for (int i = 0; i < 25; ++i) REQUIRE(std::abs(smoothed[i] / area - c[i]) < 20 * angle * angle);
}

TEST_CASE("profiles that are polynomials between their breaks project exactly") {
  // The cosine lobe's own coefficients in closed form: sqrt((2l+1)/4pi) A_l.
  const std::array<double, 1> kink{0};
  const int order = 12;
  const auto zonal = projectZonal(
      order, [](double u) { return std::max(0.0, u); }, kink, order / 2 + 1);
  for (int l = 0; l < order; ++l)
    REQUIRE(std::abs(zonal[l] - std::sqrt((2 * l + 1) / (4 * kPi)) * cosineLobe(l)) < 1e-14);
  REQUIRE_THROWS_AS(projectZonal(
                        3, [](double) { return 1.0; }, std::array{0.5, 0.2}, 4),
                    Error);
  REQUIRE_THROWS_AS(projectZonal(
                        3, [](double) { return 1.0; }, std::array{-1.5}, 4),
                    Error);
  REQUIRE_THROWS_AS(projectZonal(
                        0, [](double) { return 1.0; }, {}, 4),
                    Error);
  REQUIRE_THROWS_AS(projectZonal(
                        3, [](double) { return 1.0; }, {}, 0),
                    Error);
}

TEST_CASE("caps equal quadrature of their profile at every order and size") {
  for (const double angle : {1e-3, 0.1, 0.5, kPi / 2, 2.0, 3.1}) {
    const int order = 33;
    const auto cap = zonalCap(order, angle);
    const double edge = std::cos(angle);
    const auto slow = projectZonal(
        order, [&](double u) { return u > edge ? 1.0 : 0.0; }, std::array{edge}, 40);
    REQUIRE(maxDifference(cap, slow) < 1e-13);
  }
}

TEST_CASE("caps at their limits: sqrt(4 pi) for the whole sphere, the solid angle for a small one") {
  const auto all = zonalCap(5, kPi);
  REQUIRE(all[0] == Approx(std::sqrt(4 * kPi)).epsilon(1e-15));
  for (int l = 1; l < 5; ++l) REQUIRE(std::abs(all[l]) < 1e-15);
  for (const double v : zonalCap(5, 0)) REQUIRE(v == 0);
  // The digits survive where cos(angle) rounds to 1: pi angle^2 times y_l0 at the pole.
  const double tiny = 1e-9;
  const auto small = zonalCap(5, tiny);
  for (int l = 0; l < 5; ++l) {
    REQUIRE(small[l] == Approx(kPi * tiny * tiny * std::sqrt((2 * l + 1) / (4 * kPi))).epsilon(1e-14));
  }
  REQUIRE_THROWS_AS(zonalCap(3, -0.1), Error);
  REQUIRE_THROWS_AS(zonalCap(3, 3.2), Error);
  REQUIRE_THROWS_AS(zonalCap(3, NAN), Error);
}

TEST_CASE("Green's synthetic light of order 4 is the cap to its ten digits") {
  for (const double t : {0.2, 0.7, 1.5, 2.8}) {
    const double c = std::cos(t), s2 = std::sin(t) * std::sin(t);
    const auto cap = zonalCap(4, t);
    REQUIRE(std::abs(cap[0] - (1.772453851 - 1.772453851 * c)) < 2e-9);
    REQUIRE(std::abs(cap[1] - 1.534990062 * s2) < 2e-9);
    REQUIRE(std::abs(cap[2] - (-1.98166365 * c * c * c + 1.98166365 * c)) < 2e-8);
    REQUIRE(std::abs(cap[3] - (2.930920062 - 2.930920062 * c * c * c * c - 3.517104075 * s2)) < 2e-9);
  }
}
