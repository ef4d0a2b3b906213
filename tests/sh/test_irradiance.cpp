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
