// The basis: indices, absolute values and directions, orthonormality, addition theorem, poles, high degrees.
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

namespace {

/// y_lm from angles by the standard library's associated Legendre functions, which carry no Condon-Shortley phase.
double polarHarmonic(int l, int m, double theta, double phi) {
  const unsigned a = static_cast<unsigned>(std::abs(m));
  const double q = std::sph_legendre(static_cast<unsigned>(l), a, theta) * (a % 2 == 0 ? 1 : -1);
  if (m == 0) return q;
  return std::numbers::sqrt2 * q * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
}

}  // namespace

TEST_CASE("indices round-trip and follow the degree") {
  STATIC_REQUIRE(coefficientCount(3) == 9);
  STATIC_REQUIRE(index(0, 0) == 0);
  STATIC_REQUIRE(index(3, -3) == 9);
  STATIC_REQUIRE(degreeOf(8) == 2);
  STATIC_REQUIRE(degreeOf(9) == 3);
  int i = 0;
  for (int l = 0; l < 300; ++l) {
    for (int m = -l; m <= l; ++m, ++i) {
      REQUIRE(index(l, m) == i);
      REQUIRE(degreeOf(i) == l);
      REQUIRE(orderOf(i) == m);
    }
  }
  REQUIRE(degreeOf(std::numeric_limits<int>::max()) == 46340);
}

TEST_CASE("values in absolute directions: no Condon-Shortley phase, z polar") {
  const auto x = basisAt(3, {1, 0, 0}), y = basisAt(3, {0, 1, 0}), z = basisAt(3, {0, 0, 1});
  const double k1 = std::sqrt(3 / (4 * kPi));
  REQUIRE(x[0] == Approx(0.5 / std::sqrt(kPi)).epsilon(1e-15));
  REQUIRE(x[3] == Approx(k1).epsilon(1e-15));
  REQUIRE(y[1] == Approx(k1).epsilon(1e-15));
  REQUIRE(z[2] == Approx(k1).epsilon(1e-15));
  REQUIRE(x[8] == Approx(std::sqrt(15 / (16 * kPi))).epsilon(1e-15));
  REQUIRE(y[8] == Approx(-std::sqrt(15 / (16 * kPi))).epsilon(1e-15));
  const double h = std::sqrt(0.5);
  REQUIRE(basisAt(3, {h, h, 0})[4] == Approx(std::sqrt(15 / (16 * kPi))).epsilon(1e-15));
  REQUIRE(basisAt(3, {0, h, h})[5] == Approx(std::sqrt(15 / (16 * kPi))).epsilon(1e-15));
  REQUIRE(basisAt(3, {h, 0, h})[7] == Approx(std::sqrt(15 / (16 * kPi))).epsilon(1e-15));
}

TEST_CASE("values agree with associated Legendre functions of the standard library to order 33") {
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3d d = randomDirection(1, trial);
    const auto values = basisAt(33, d);
    const double theta = std::acos(d.z), phi = std::atan2(d.y, d.x);
    for (int i = 0; i < coefficientCount(33); ++i) {
      REQUIRE(std::abs(values[i] - polarHarmonic(degreeOf(i), orderOf(i), theta, phi)) < 2e-13);
    }
  }
}

TEST_CASE("polynomials of the low orders equal the recurrence, poles included") {
  std::vector<Vec3d> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1e-200, 0, 1}, {0, 1e-9, -1}};
  for (int i = 0; i < 500; ++i) directions.push_back(randomDirection(2, i));
  std::array<double, 36> recurrence;
  for (const Vec3d& d : directions) {
    for (int order = 1; order <= 6; ++order) {
      oracle::evaluateByRecurrence(order, d, recurrence);
      const std::size_t count = coefficientCount(order);
      REQUIRE(maxDifference(basisAt(order, d), std::span(recurrence).first(count)) < 1e-14);
    }
  }
}

TEST_CASE("at the poles only m = 0 is left, with the value sqrt((2l+1)/4pi)") {
  for (const double z : {1.0, -1.0}) {
    const auto y = basisAt(33, {0, 0, z});
    for (int i = 0; i < coefficientCount(33); ++i) {
      const int l = degreeOf(i);
      const double expected = orderOf(i) == 0 ? std::sqrt((2 * l + 1) / (4 * kPi)) * (z < 0 && l % 2 ? -1 : 1) : 0;
      REQUIRE(std::abs(y[i] - expected) < 1e-13);
    }
  }
}

TEST_CASE("addition theorem to degree 1000") {
  const int order = 1001;
  for (const Vec3d& d : {randomDirection(3, 0), randomDirection(3, 1), Vec3d{0, 0, 1},
                         normalized(Vec3d{1e-3, 2e-4, -1}), normalized(Vec3d{1, 1, 1e-9})}) {
    const auto y = basisAt(order, d);
    for (int l = 0; l < order; ++l) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += y[index(l, m)] * y[index(l, m)];
      // Half a unit in the last place of z moves degree l by l^2 / 2 of that at the poles.
      REQUIRE(std::abs(sum * 4 * kPi / (2 * l + 1) - 1) < (10.0 + l * l) * std::numeric_limits<double>::epsilon());
    }
  }
}

TEST_CASE("addition theorem between two directions is the Legendre polynomial") {
  const int order = 40;
  for (int trial = 0; trial < 10; ++trial) {
    const Vec3d a = randomDirection(4, 2 * trial), b = randomDirection(4, 2 * trial + 1);
    const auto ya = basisAt(order, a), yb = basisAt(order, b);
    for (int l = 0; l < order; ++l) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += ya[index(l, m)] * yb[index(l, m)];
      const double expected = (2 * l + 1) / (4 * kPi) * std::legendre(static_cast<unsigned>(l), dot(a, b));
      REQUIRE(std::abs(sum - expected) < 1e-12);
    }
  }
}

TEST_CASE("single precision follows double precision at every order") {
  for (const int order : {1, 2, 3, 4, 5, 6, 7, 33}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3f d(randomDirection(5, trial));
      std::vector<float> single(coefficientCount(order));
      evaluate(order, d, single);
      const auto twin = basisAt(order, Vec3d(d));
      // The low orders are computed in float: about ten roundings of values up to 2.
      const double tolerance = 20 * std::numeric_limits<float>::epsilon();
      for (std::size_t i = 0; i < twin.size(); ++i) REQUIRE(std::abs(single[i] - twin[i]) < tolerance);
    }
  }
}

TEST_CASE("errata of the basis: printed forms are not orthonormal") {
  // Green's eq. 10 has 1/2 sqrt(15/pi) (x^2 - y^2) for l = 2, m = 2; its norm squared is 4. A uniform product rule with
  // 8 azimuths and Simpson's rule in z, both exact for this polynomial, gives the norms.
  const auto normSquared = [](auto f) {
    double sum = 0;
    for (int a = 0; a < 8; ++a) {
      const double phi = 2 * kPi * a / 8;
      // Gauss's 5-point rule on [-1, 1] from its closed form.
      const double p = 2 * std::sqrt(10.0 / 7), n1 = std::sqrt(5 - p) / 3, n2 = std::sqrt(5 + p) / 3;
      const double w1 = (322 + 13 * std::sqrt(70.0)) / 900, w2 = (322 - 13 * std::sqrt(70.0)) / 900;
      const double nodes[] = {-n2, -n1, 0, n1, n2}, weights[] = {w2, w1, 128.0 / 225, w1, w2};
      for (int i = 0; i < 5; ++i) {
        const double r = std::sqrt(1 - nodes[i] * nodes[i]);
        const double v = f(Vec3d{r * std::cos(phi), r * std::sin(phi), nodes[i]});
        sum += weights[i] * 2 * kPi / 8 * v * v;
      }
    }
    return sum;
  };
  const auto printed = [](const Vec3d& d) { return 0.5 * std::sqrt(15 / kPi) * (d.x * d.x - d.y * d.y); };
  const auto ours = [](const Vec3d& d) { return basisAt(3, d)[8]; };
  REQUIRE(normSquared(printed) == Approx(4).epsilon(1e-13));
  REQUIRE(normSquared(ours) == Approx(1).epsilon(1e-13));

  // A page on irradiance maps has P_mm = (1-2m) P_{m-1,m-1} without sin(theta): norm squared of y_11 is then 1.5,
  // not 1.
  const auto withoutSine = [](const Vec3d& d) { return std::sqrt(3 / (4 * kPi)) * d.x / std::hypot(d.x, d.y); };
  REQUIRE(normSquared(withoutSine) == Approx(1.5).epsilon(1e-13));
  REQUIRE(normSquared([](const Vec3d& d) { return basisAt(2, d)[3]; }) == Approx(1).epsilon(1e-13));
}

TEST_CASE("errata of the basis: m < 0 carries sin |m| phi, and K carries (l + |m|)!") {
  const Vec3d d = randomDirection(6, 0);
  const double phi = std::atan2(d.y, d.x), r = std::hypot(d.x, d.y);
  const double k1 = std::sqrt(3 / (4 * kPi));
  const double printedCosine = k1 * r * std::cos(-phi);
  REQUIRE(std::abs(basisAt(2, d)[1] - k1 * r * std::sin(phi)) < 1e-15);
  REQUIRE(std::abs(basisAt(2, d)[1] - printedCosine) > 0.1);

  // K_{2,-2}: (l - |m|)! / (l + m)! = 0! / 0! as printed, 0! / 4! in truth.
  const double printedK = std::sqrt(5 / (4 * kPi) * 1 / 1), k = std::sqrt(5 / (4 * kPi) / 24);
  const double shape = std::numbers::sqrt2 * 3 * r * r * std::sin(2 * phi);
  REQUIRE(std::abs(basisAt(3, d)[4] - k * shape) < 1e-15);
  REQUIRE(std::abs(basisAt(3, d)[4] - printedK * shape) > 0.1);
}

TEST_CASE("the highest order is finite, where factorials would overflow from degree 86 on") {
  for (const double v : basisAt(kMaxBasisOrder, normalized(Vec3d{0.3, 0.1, 1e-3}))) REQUIRE(std::isfinite(v));
  for (const double v : basisAt(kMaxBasisOrder, normalized(Vec3d{1e-4, 1e-4, 1}))) REQUIRE(std::isfinite(v));
}

TEST_CASE("orders out of range and short outputs are usage errors") {
  std::vector<double> out(9);
  REQUIRE_THROWS_AS(evaluate(0, Vec3d{0, 0, 1}, out), Error);
  REQUIRE_THROWS_AS(evaluate(-3, Vec3d{0, 0, 1}, out), Error);
  REQUIRE_THROWS_AS(evaluate(4, Vec3d{0, 0, 1}, out), Error);
  REQUIRE_THROWS_AS(evaluate(kMaxBasisOrder + 1, Vec3d{0, 0, 1}, out), Error);
  REQUIRE_NOTHROW(evaluate(3, Vec3d{0, 0, 1}, out));
}
