// Irradiance through a cone.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/ao_cone.h"
#include "sh/irradiance.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("cone lobes have the printed closed forms of degrees 0 to 2") {
  for (const double t : {0.0, 0.1, 0.7, 0.95, 0.999999, 1.0}) {
    const double t2 = t * t, t3 = t2 * t, t4 = t2 * t2;
    REQUIRE(std::abs(coneCosineLobe(0, t) - kPi * (1 - t2)) < 2e-15);
    REQUIRE(std::abs(coneCosineLobe(1, t) - 2 * kPi / 3 * (1 - t3)) < 2e-15);
    REQUIRE(std::abs(coneCosineLobe(2, t) - kPi / 4 * (3 * (1 - t4) - 2 * (1 - t2))) < 2e-15);
  }
}

TEST_CASE("a full cone is the hemisphere, at any degree") {
  for (int l = 0; l <= 40; ++l) REQUIRE(std::abs(coneCosineLobe(l, 0) - cosineLobe(l)) < 2e-15);
}

TEST_CASE("odd degrees count for narrow cones: degree 3 at t = 0.7") {
  REQUIRE(std::abs(coneCosineLobe(3, 0.7) - 0.5496) < 5e-5);
}

TEST_CASE("cone lobes equal their integral") {
  const int n = 100000;
  for (const int l : {0, 3, 7, 20}) {
    for (const double t : {0.2, 0.7, 0.98}) {
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        const double u = t + (1 - t) * (i + 0.5) / n;
        sum += u * std::legendre(static_cast<unsigned>(l), u);
      }
      // Midpoints err by (1-t)^3 / 24 n^2 times the second derivative, at most l^4: 7e-7 at worst.
      REQUIRE(std::abs(2 * kPi * sum * (1 - t) / n - coneCosineLobe(l, t)) < 1e-6);
    }
  }
}

TEST_CASE("erratum: a share of 1/4 of the sky is a cone of 30 degrees, not 22.5") {
  const double white = std::sqrt(4 * kPi);
  const std::vector<double> sky{white};
  const Vec3d up{0, 0, 1};
  for (const double share : {0.0, 0.25, 0.5, 0.9, 1.0}) {
    REQUIRE(std::abs(coneIrradiance(1, sky, up, coneFromCosineVisibility(share)) - kPi * share) < 1e-14);
  }
  REQUIRE(std::acos(coneFromCosineVisibility(0.25)) == Approx(kPi / 6).epsilon(1e-14));
  const double printed = std::cos(kPi / 2 * 0.25);
  REQUIRE(std::abs(coneIrradiance(1, sky, up, printed) - kPi * 0.25) > 0.1);
  // Solid angle 2 pi (1 - cos t) as a share of the hemisphere.
  REQUIRE(coneFromUniformVisibility(0.25) == 0.75);
}

TEST_CASE("a hemisphere's cone irradiance is irradiance") {
  const auto light = randomCoefficients(5, 140);
  const Vec3d n = randomDirection(141, 0);
  REQUIRE(std::abs(coneIrradiance(5, light, n, 0) - irradianceAt(5, light, n)) < 1e-14);
}

TEST_CASE("shares and cosines out of range are refused") {
  REQUIRE_THROWS_AS(coneCosineLobe(2, -0.1), Error);
  REQUIRE_THROWS_AS(coneCosineLobe(2, 1.1), Error);
  REQUIRE_THROWS_AS(coneCosineLobe(2, NAN), Error);
  REQUIRE_THROWS_AS(coneCosineLobe(-1, 0.5), Error);
  REQUIRE_THROWS_AS(coneFromCosineVisibility(1.01), Error);
  REQUIRE_THROWS_AS(coneFromUniformVisibility(-0.01), Error);
}
