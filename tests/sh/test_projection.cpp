// Projection, reconstruction, product integrals; Green's light.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/green_light.h"
#include "sh/projection.h"
#include "sh/quadrature.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("projection of a band-limited function gives its coefficients back") {
  for (const int order : {1, 2, 4, 12}) {
    const auto c = randomCoefficients(order, 90);
    const auto back = project(
        order, [&](const Vec3d& d) { return valueAt(order, c, d); }, order - 1);
    REQUIRE(maxDifference(back, c) < 1e-13);
  }
}

TEST_CASE("a constant light fills coefficient 0 alone, with sqrt(4 pi) times its radiance") {
  const auto c = projectRgb(
      5,
      [](const Vec3d&) {
        return Vec3d{1, 2, 3};
      },
      0);
  const double whole = std::sqrt(4 * kPi);
  REQUIRE(length(c[0] - Vec3d{whole, 2 * whole, 3 * whole}) < 1e-14);
  for (int i = 1; i < 25; ++i) REQUIRE(length(c[i]) < 1e-14);
  // Erratum: the Monte Carlo weight is 4 pi / N; "w = 1 / 4 pi" would give a coefficient (4 pi)^2 times too small.
  const std::vector<Vec3d> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
  const std::vector<double> right(4, 4 * kPi / 4), printed(4, 1 / (4 * kPi) / 4);
  REQUIRE(projectSamples(1, directions, right)[0] == Approx(whole).epsilon(1e-15));
  REQUIRE(projectSamples(1, directions, printed)[0] * 16 * kPi * kPi == Approx(whole).epsilon(1e-15));
}

TEST_CASE("Green's light has these coefficients, and the printed list differs") {
  const double expected[16] = {
      0.398802116, 0.210523682, 0.286531478, -0.281817133, -0.314993072, 0,           0.131378107, 0,
      0.093179019, 0.249605514, 0,           -0.123359021, 0.303877792,  0.165134322, 0,           0.092241033};
  const auto c = greenCoefficients(4);
  for (int i = 0; i < 16; ++i) REQUIRE(std::abs(c[i] - expected[i]) < 1e-9);

  // By quadrature over the sphere: kinks leave an error that falls as degree^-2.
  REQUIRE(maxDifference(project(4, greenLight, 600), c) < 2e-5);

  // The printed list is in the Condon-Shortley basis and lacks number 9; number 8 has the wrong sign. Its Monte Carlo
  // noise is below 1.1e-3 a coefficient, so that 5e-3 tells a misprint from noise.
  const double printed[9] = {0.39925, -0.21075, 0.28687, 0.28277, -0.31530, -0.00040, 0.13159, 0.00098, -0.09359};
  for (int i = 0; i < 9; ++i) {
    const double phase = orderOf(i) % 2 == 0 ? 1 : -1;
    REQUIRE((std::abs(printed[i] - phase * c[i]) < 5e-3) == (i != 8));
  }
  REQUIRE(std::abs(-printed[8] - c[8]) < 5e-3);
  const double printedNine = -0.00072;
  REQUIRE(std::abs(printedNine - -c[9]) > 0.2);
}

TEST_CASE("erratum: with the printed bracket of the two-light example the mean is negative") {
  const double topMean = 0.1 * 2 * kPi, sideMean = 4 * kPi, three = 3 * 4 * kPi;
  const double printed = (topMean + sideMean - three) / std::sqrt(4 * kPi);
  REQUIRE(printed == Approx(-6.9126).epsilon(1e-4));
  REQUIRE(greenCoefficients(1)[0] > 0);
}

TEST_CASE("reconstruction error of Green's light falls with the order as known") {
  const double expected[] = {0.912, 0.783, 0.693, 0.512, 0.283, 0.159};
  for (int order = 1; order <= 6; ++order) {
    REQUIRE(std::abs(greenError(greenCoefficients(order)) - expected[order - 1]) < 5e-4);
  }
}

TEST_CASE("sample projection is unbiased: a mean of uniform samples agrees within its standard error") {
  const int order = 4, n = 20000;
  const auto exact = greenCoefficients(order);
  std::vector<double> sum(16), squares(16), scratch(16), one(16);
  for (int k = 0; k < n; ++k) {
    const Vec3d d = randomDirection(91, k);
    std::fill(one.begin(), one.end(), 0.0);
    accumulateSample(order, d, 4 * kPi * greenLight(d), scratch, one);
    for (int i = 0; i < 16; ++i) {
      sum[i] += one[i];
      squares[i] += one[i] * one[i];
    }
  }
  for (int i = 0; i < 16; ++i) {
    const double mean = sum[i] / n, error = std::sqrt((squares[i] / n - mean * mean) / n);
    // The variance is at most (4 pi)^2 times the mean of light^2 y^2, and y^2 <= 7 / 4 pi below degree 4: what keeps
    // the test sharp. One of 16 means beyond 4.5 standard errors happens once in 10,000 seeds.
    REQUIRE(error < std::sqrt(7 * kGreenEnergy / n));
    REQUIRE(std::abs(mean - exact[i]) < 4.5 * error);
  }
}

TEST_CASE("the dot product of coefficients is the integral of the product") {
  const int orderA = 6, orderB = 9;
  const auto a = randomCoefficients(orderA, 92), b = randomCoefficients(orderB, 93);
  const double integral = SphereRule(orderA + orderB).integrate([&](const Vec3d& d) {
    return valueAt(orderA, a, d) * valueAt(orderB, b, d);
  });
  REQUIRE(std::abs(productIntegral(a, b) - integral) < 1e-12);
  REQUIRE(productIntegral(a, b) == productIntegral(b, a));
}

TEST_CASE("reconstruction is the sum from coefficient 0 on") {
  const auto c = randomCoefficients(4, 94);
  const Vec3d d = randomDirection(95, 0);
  REQUIRE(reconstruct(4, c, d) == Approx(valueAt(4, c, d)).epsilon(1e-15));
  // Erratum: a sum printed from c_1 y_1 on leaves out the mean.
  auto fromOne = c;
  fromOne[0] = 0;
  REQUIRE(std::abs(valueAt(4, fromOne, d) - reconstruct(4, c, d)) > 1e-3);
}

TEST_CASE("band energies add up to the integral of the square") {
  const int order = 5;
  const auto c = randomCoefficients(order, 96);
  const auto energy = bandEnergy(order, c);
  double sum = 0;
  for (const double e : energy) sum += e;
  const double integral =
      SphereRule(2 * order).integrate([&](const Vec3d& d) { return valueAt(order, c, d) * valueAt(order, c, d); });
  REQUIRE(sum == Approx(integral).epsilon(1e-13));
  REQUIRE(energy[1] == Approx(c[1] * c[1] + c[2] * c[2] + c[3] * c[3]).epsilon(1e-15));
}

TEST_CASE("projection refuses what it cannot do") {
  const auto one = [](const Vec3d&) { return 1.0; };
  REQUIRE_THROWS_AS(project(0, one, 3), Error);
  REQUIRE_THROWS_AS(project(3, one, -1), Error);
  const std::vector<Vec3d> two(2);
  const std::vector<double> three(3);
  REQUIRE_THROWS_AS(projectSamples(2, two, three), Error);
  REQUIRE_THROWS_AS(reconstruct(2, three, {0, 0, 1}), Error);
  REQUIRE_THROWS_AS(bandEnergy(2, three), Error);
}
