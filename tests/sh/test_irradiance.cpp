// The clamped cosine.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/irradiance.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("cosine lobe has its known values") {
  const double expected[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0, kPi / 64, 0, -kPi / 128, 0, 7 * kPi / 1536};
  for (int l = 0; l <= 10; ++l) REQUIRE(cosineLobe(l) == Approx(expected[l]).epsilon(1e-15));
  REQUIRE_THROWS_AS(cosineLobe(-1), Error);
}

TEST_CASE("cosine lobe equals its integral at every degree to 60") {
  // 2 pi times the integral of u P_l(u) over [0, 1] by 200,000 midpoints: error below l^2 2 pi / (24 * 4e10).
  const int n = 200000;
  for (const int l : {0, 1, 2, 3, 4, 5, 8, 17, 32, 60}) {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double u = (i + 0.5) / n;
      sum += u * std::legendre(static_cast<unsigned>(l), u);
    }
    REQUIRE(std::abs(2 * kPi * sum / n - cosineLobe(l)) < 1e-7);
  }
}

TEST_CASE("erratum: (l!/2)^2 instead of (l/2)!^2 is right at l = 2 only") {
  const auto printed = [](int l) {
    const double factorial = std::tgamma(l + 1.0), sign = l / 2 % 2 == 0 ? -1 : 1;
    return sign * 2 * kPi * factorial / (std::pow(2.0, l) * factorial * factorial / 4) / ((l + 2.0) * (l - 1.0));
  };
  REQUIRE(printed(2) == Approx(cosineLobe(2)));
  REQUIRE(printed(4) == Approx(-0.0036361).epsilon(1e-4));
  REQUIRE(printed(0) == Approx(4 * kPi));
  REQUIRE(std::abs(printed(4) - cosineLobe(4)) > 0.1);
}

TEST_CASE("an open diffuse point under a white sky radiates its albedo") {
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<double> t(25);
    unshadowedTransfer(5, randomDirection(40, trial), 0.37, t);
    const double whiteSky = std::sqrt(4 * kPi);  // the coefficient of radiance 1 from everywhere
    REQUIRE(whiteSky * t[0] == Approx(0.37).epsilon(1e-15));
  }
}

TEST_CASE("unshadowed transfer is the cosine lobe about the normal") {
  const Vec3d n = randomDirection(41, 0);
  std::vector<double> t(36);
  unshadowedTransfer(6, n, 0.5, t);
  const auto y = basisAt(6, n);
  for (int i = 0; i < 36; ++i) REQUIRE(t[i] == Approx(0.5 / kPi * cosineLobe(degreeOf(i)) * y[i]).margin(1e-16));
}

TEST_CASE("the unshadowed norm is the length of the unshadowed transfer") {
  for (const int order : {1, 2, 3, 4, 5, 6, 10, 33}) {
    std::vector<double> t(coefficientCount(order));
    unshadowedTransfer(order, randomDirection(42, order), 1, t);
    double sum = 0;
    for (const double v : t) sum += v * v;
    REQUIRE(std::sqrt(sum) == Approx(unshadowedNorm(order)).epsilon(1e-14));
  }
  // Parseval: the limit is the norm of max(cos, 0) / pi, sqrt(2 pi / 3) / pi.
  REQUIRE(unshadowedNorm(1000) == Approx(std::sqrt(2 * kPi / 3) / kPi).epsilon(1e-9));
}

TEST_CASE("truncated cosine lobes: energy kept and greatest error of orders 1 to 3") {
  // max(u, 0) = 1/4 + u/2 + 5/16 P_2(u) + ..., of squared norm 2 pi / 3.
  const double energy[] = {0.375, 0.875, 0.9921875}, error[] = {0.75, 0.25, 0.09375};
  for (int order = 1; order <= 3; ++order) {
    const double kept = unshadowedNorm(order) * kPi;
    REQUIRE(kept * kept / (2 * kPi / 3) == Approx(energy[order - 1]).epsilon(1e-14));
    std::vector<double> lobe(coefficientCount(order));
    unshadowedTransfer(order, {0, 0, 1}, kPi, lobe);
    double largest = 0, least = 0;
    for (int i = 0; i <= 2000; ++i) {
      const double u = -1 + i / 1000.0, value = valueAt(order, lobe, {std::sqrt(1 - u * u), 0, u});
      largest = std::max(largest, std::abs(value - std::max(u, 0.0)));
      least = std::min(least, value);
    }
    REQUIRE(largest == Approx(error[order - 1]).epsilon(1e-12));
    if (order == 2) REQUIRE(least == Approx(-0.25).epsilon(1e-12));
  }
}

TEST_CASE("irradiance is the integral of radiance times the cosine") {
  // A light of order 3 and a normal along z: the integral over the upper hemisphere as a polynomial rule in z and
  // azimuth.
  const auto light = randomCoefficients(3, 43);
  const int nodes = 2000, azimuths = 8;
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double z = (i + 0.5) / nodes, r = std::sqrt(1 - z * z);
    for (int k = 0; k < azimuths; ++k) {
      const double phi = 2 * kPi * (k + 0.5) / azimuths;
      sum += z * valueAt(3, light, {r * std::cos(phi), r * std::sin(phi), z});
    }
  }
  // Midpoints err by at most (second derivative, below 20) / (24 nodes^2) times 2 pi.
  REQUIRE(std::abs(sum * 2 * kPi / (nodes * azimuths) - irradianceAt(3, light, {0, 0, 1})) < 2e-6);
  std::vector<double> e(9);
  irradiance(3, light, e);
  const Vec3d n = randomDirection(44, 0);
  REQUIRE(std::abs(valueAt(3, e, n) - irradianceAt(3, light, n)) < 1e-14);
  REQUIRE_THROWS_AS(irradiance(4, light, e), Error);
  REQUIRE_THROWS_AS(irradianceAt(4, light, n), Error);
}

TEST_CASE("the constants of nine-coefficient shaders; the comment 1/4 sqrt(15 pi) for .4290 is wrong") {
  const double k2 = cosineLobe(2), k1 = cosineLobe(1), k0 = cosineLobe(0);
  const auto x = basisAt(3, {1, 0, 0}), z = basisAt(3, {0, 0, 1});
  REQUIRE(k2 * x[8] == Approx(0.429043).epsilon(2e-6));
  REQUIRE(k2 * x[8] == Approx(std::sqrt(15 * kPi) / 16).epsilon(1e-14));
  REQUIRE(std::abs(k2 * x[8] - std::sqrt(15 * kPi) / 4) > 1);
  REQUIRE(k1 * x[3] / 2 == Approx(0.511663).epsilon(2e-6));
  REQUIRE(k2 * z[6] / 2 == Approx(0.247708).epsilon(2e-6));
  REQUIRE(k0 * x[0] == Approx(0.886227).epsilon(2e-6));
}
