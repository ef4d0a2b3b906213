// Hazel's normalisation and the non-linear irradiance of order 2.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/hazel.h"
#include "sh/irradiance.h"
#include "sh/quadrature.h"
#include "sh/support.h"
#include "sh/zonal.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

namespace {

/// Root of the mean of f^2 over the sphere for f of the cosine to an axis, with a kink at the equator.
template <class F>
double rms(F&& f) {
  const IntervalRule rule = gaussLegendre(40);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    for (const double side : {-1.0, 1.0}) {
      const double u = side * (1 + rule.nodes[i]) / 2, v = f(u);
      sum += rule.weights[i] / 4 * v * v;
    }
  }
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("Hazel's parts are the means over the sphere, in absolute directions") {
  const auto c = randomCoefficients(3, 150);
  const HazelLight h = toHazel(c);
  const SphereRule rule(4);
  const auto mean = [&](auto weight) {
    return rule.integrate([&](const Vec3d& d) { return valueAt(3, c, d) * weight(d); }) / (4 * kPi);
  };
  REQUIRE(std::abs(h.r0 - mean([](const Vec3d&) { return 1.0; })) < 1e-15);
  REQUIRE(std::abs(h.r1.x - mean([](const Vec3d& d) { return d.x; })) < 1e-15);
  REQUIRE(std::abs(h.r1.y - mean([](const Vec3d& d) { return d.y; })) < 1e-15);
  REQUIRE(std::abs(h.r1.z - mean([](const Vec3d& d) { return d.z; })) < 1e-15);
  REQUIRE(std::abs(h.xx - mean([](const Vec3d& d) { return d.x * d.x - 1.0 / 3; })) < 1e-15);
  REQUIRE(std::abs(h.yy - mean([](const Vec3d& d) { return d.y * d.y - 1.0 / 3; })) < 1e-15);
  REQUIRE(std::abs(h.zz - mean([](const Vec3d& d) { return d.z * d.z - 1.0 / 3; })) < 1e-15);
  REQUIRE(std::abs(h.xy - mean([](const Vec3d& d) { return d.x * d.y; })) < 1e-15);
  REQUIRE(std::abs(h.xz - mean([](const Vec3d& d) { return d.x * d.z; })) < 1e-15);
  REQUIRE(std::abs(h.yz - mean([](const Vec3d& d) { return d.y * d.z; })) < 1e-15);
  // Erratum: the trace is 11 + 22 + 33, where 00 + 11 + 33 is printed.
  REQUIRE(std::abs(h.xx + h.yy + h.zz) < 1e-16);
}

TEST_CASE("Hazel's form converts both ways, and reconstructs what order 3 does") {
  for (int trial = 0; trial < 50; ++trial) {
    const auto c = randomCoefficients(3, 151 + trial);
    const HazelLight h = toHazel(c);
    REQUIRE(maxDifference(toCoefficients(h), c) < 1e-15);
    const Vec3d d = randomDirection(152, trial);
    REQUIRE(std::abs(radiance(h, d) - valueAt(3, c, d)) < 1.5e-14);
    // Hazel's I is E / pi.
    REQUIRE(std::abs(kPi * diffuse(h, d) - irradianceAt(3, c, d)) < 4e-14);
  }
}

TEST_CASE("a matrix with a trace gives the coefficients of its traceless part") {
  HazelLight h;
  h.xx = h.yy = h.zz = 0.7;
  for (const double v : toCoefficients(h)) REQUIRE(std::abs(v) < 1e-15);
}

TEST_CASE("the quadric has the value of the diffuse form") {
  const HazelLight h = toHazel(randomCoefficients(3, 153));
  const auto m = diffuseQuadric(h);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3d n = randomDirection(154, trial);
    const double v[] = {n.x, n.y, n.z, 1};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) sum += v[i] * m[i][j] * v[j];
    }
    REQUIRE(std::abs(sum - diffuse(h, n)) < 1e-15 * 20);
  }
}

TEST_CASE("a disc of half-angle t has |R1| / R0 = (1 + cos t) / 2, towards its middle") {
  const Vec3d axis = randomDirection(155, 0);
  for (const double t : {0.05, 0.5, 1.5, 3.0}) {
    std::vector<double> c(9);
    rotateZonal(zonalCap(3, t), axis, c);
    const HazelLight h = toHazel(c);
    REQUIRE(length(h.r1) / h.r0 == Approx((1 + std::cos(t)) / 2).epsilon(1e-13));
    REQUIRE(length(normalized(h.r1) - axis) < 1e-13);
  }
}

TEST_CASE("linear irradiance has its least value R0 - 2|R1| opposite the light, negative beyond |R1| = R0 / 2") {
  const Vec3d r1{0.1, -0.5, 0.3}, back = -normalized(r1);
  REQUIRE(diffuseLinear(1, r1, back) == Approx(1 - 2 * length(r1)).epsilon(1e-14));
  REQUIRE(diffuseLinear(1, r1, back) < 0);
  REQUIRE(diffuseLinear(1, r1 * 0.5, back) > 0);
}

TEST_CASE("antipodal identity: n.R1 is a quarter of E(n) - E(-n) over pi, with exact irradiance") {
  const int order = 20;
  const auto light = randomCoefficients(order, 156);
  const HazelLight h = toHazel(light);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3d n = randomDirection(157, trial);
    const double difference = (irradianceAt(order, light, n) - irradianceAt(order, light, -n)) / kPi;
    REQUIRE(std::abs(dot(n, h.r1) - difference / 4) < 1e-14);
  }
}

TEST_CASE("non-linear irradiance keeps the mean and the antipodal difference, and is never negative") {
  const Vec3d axis = randomDirection(158, 0);
  for (const double r : {1e-12, 0.1, 0.3, 0.5, 0.8, 0.999, 1.0}) {
    const double r0 = 2.5;
    const Vec3d r1 = axis * (r * r0);
    // The mean over the sphere: a + (1 - a)(p + 1) times the mean of q^p with q uniform on [0, 1], by a rule in s =
    // q^(1/4) that smooths the power at 0.
    const IntervalRule rule = gaussLegendre(200);
    double mean = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double s = (1 + rule.nodes[i]) / 2, q = s * s * s * s, u = 2 * q - 1;
      const Vec3d side = normalized(cross(axis, Vec3d{1, 2, 3}));
      const Vec3d n = axis * u + side * std::sqrt(std::max(0.0, 1 - u * u));
      mean += rule.weights[i] / 2 * 4 * s * s * s * diffuseNonlinear(r0, r1, n);
    }
    REQUIRE(std::abs(mean - r0) < 1e-12);
    const double difference = diffuseNonlinear(r0, r1, axis) - diffuseNonlinear(r0, r1, -axis);
    REQUIRE(std::abs(difference - 4 * length(r1)) < 1e-13);
    for (int i = 0; i < 200; ++i) REQUIRE(diffuseNonlinear(r0, r1, randomDirection(159, i)) >= 0);
  }
}

TEST_CASE("non-linear irradiance survives its corners") {
  const Vec3d z{0, 0, 1};
  REQUIRE(diffuseNonlinear(2, {0, 0, 0}, z) == 2);
  REQUIRE(diffuseNonlinear(0, {0, 0, 0}, z) == 0);
  REQUIRE(diffuseNonlinear(-1, {0, 0, 1}, z) == 0);
  REQUIRE(diffuseNonlinear(NAN, {0, 0, 1}, z) == 0);
  // A normal a little too long takes the cosine below -1.
  REQUIRE(diffuseNonlinear(1, {0, 0, 0.4}, Vec3d{0, 0, -1 - 1e-15}) >= 0);
  REQUIRE(diffuseNonlinear(1, {0, 0, 1}, z) == Approx(4).epsilon(1e-15));
  REQUIRE(diffuseNonlinear(1, {0, 0, 1 + 1e-12}, z) == Approx(4).epsilon(1e-15));
  REQUIRE(diffuseNonlinear(1, {0, 0, 3}, z) == Approx(4).epsilon(1e-15));
  REQUIRE(diffuseNonlinear(1, {0, 0, 1}, -z) == 0);
}

TEST_CASE("for light from one direction: errors of linear, order-3 and non-linear irradiance") {
  // Radiance of mean 1 from +z alone: E / pi = 4 max(u, 0), R1 = z, R_2 = z z^T - 1/3.
  HazelLight h;
  h.r0 = 1;
  h.r1 = {0, 0, 1};
  h.zz = 2.0 / 3;
  h.xx = h.yy = -1.0 / 3;
  const auto at = [](double u) { return Vec3d{std::sqrt(1 - u * u), 0, u}; };
  const auto exact = [](double u) { return 4 * std::max(u, 0.0); };
  const double linear = rms([&](double u) { return diffuseLinear(1, h.r1, at(u)) - exact(u); });
  const double order3 = rms([&](double u) { return diffuse(h, at(u)) - exact(u); });
  const double nonlinear = rms([&](double u) { return diffuseNonlinear(1, h.r1, at(u)) - exact(u); });
  REQUIRE(std::abs(linear - 0.577) < 5e-4);
  REQUIRE(std::abs(order3 - 0.144) < 5e-4);
  REQUIRE(std::abs(nonlinear - 0.229) < 5e-4);
  double least = 0;
  for (int i = 0; i <= 1000; ++i) least = std::min(least, diffuse(h, at(-1 + i / 500.0)));
  REQUIRE(std::abs(least + 0.158) < 5e-4);
}

TEST_CASE("Hazel's form takes nine coefficients") {
  REQUIRE_THROWS_AS(toHazel(std::vector<double>(8)), Error);
}
