// Quadrature rules.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/quadrature.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("Gauss-Legendre rules integrate monomials to their degree, and not beyond") {
  for (const int n : {1, 2, 3, 5, 8, 33, 64, 200}) {
    const IntervalRule rule = gaussLegendre(n);
    const auto integral = [&](int power) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], power);
      return sum;
    };
    for (int power = 0; power <= 2 * n - 1; ++power) {
      REQUIRE(std::abs(integral(power) - (power % 2 == 0 ? 2.0 / (power + 1) : 0)) <
              2e-15 * (4 + std::sqrt(double(n))));
    }
    if (n <= 5) REQUIRE(std::abs(integral(2 * n) - 2.0 / (2 * n + 1)) > 1e-5);
    for (int i = 1; i < n; ++i) REQUIRE(rule.nodes[i] > rule.nodes[i - 1]);
  }
  REQUIRE_THROWS_AS(gaussLegendre(0), Error);
}

TEST_CASE("Gauss-Legendre nodes have their closed forms") {
  const IntervalRule rule = gaussLegendre(5);
  const double root = 2 * std::sqrt(10.0 / 7);
  REQUIRE(rule.nodes[2] == 0);
  REQUIRE(rule.nodes[3] == Approx(std::sqrt(5 - root) / 3).epsilon(1e-15));
  REQUIRE(rule.nodes[4] == Approx(std::sqrt(5 + root) / 3).epsilon(1e-15));
  REQUIRE(rule.weights[2] == Approx(128.0 / 225).epsilon(1e-15));
}

TEST_CASE("sphere rules integrate monomials exactly to their degree") {
  const auto exact = [](int a, int b, int c) {
    if (a % 2 || b % 2 || c % 2) return 0.0;
    return 2 * std::tgamma((a + 1) / 2.0) * std::tgamma((b + 1) / 2.0) * std::tgamma((c + 1) / 2.0) /
           std::tgamma((a + b + c + 3) / 2.0);
  };
  for (const int degree : {0, 1, 2, 5, 10}) {
    const SphereRule rule(degree);
    for (int a = 0; a <= degree; ++a) {
      for (int b = 0; a + b <= degree; ++b) {
        for (int c = 0; a + b + c <= degree; ++c) {
          const double value =
              rule.integrate([&](const Vec3d& d) { return std::pow(d.x, a) * std::pow(d.y, b) * std::pow(d.z, c); });
          REQUIRE(std::abs(value - exact(a, b, c)) < 2e-14);
        }
      }
    }
  }
  REQUIRE_THROWS_AS(SphereRule(-1), Error);
}

TEST_CASE("the basis is orthonormal: Gram matrix by exact quadrature") {
  for (const int order : {4, 20}) {
    const int count = coefficientCount(order);
    std::vector<double> gram(count * count);
    SphereRule(2 * (order - 1)).forEach([&](const Vec3d& d, double weight) {
      const auto y = basisAt(order, d);
      for (int i = 0; i < count; ++i) {
        for (int j = i; j < count; ++j) gram[i * count + j] += weight * y[i] * y[j];
      }
    });
    double largest = 0;
    for (int i = 0; i < count; ++i) {
      for (int j = i; j < count; ++j) largest = std::max(largest, std::abs(gram[i * count + j] - (i == j ? 1 : 0)));
    }
    REQUIRE(largest < 1e-12);
  }
}

TEST_CASE("the basis is orthonormal at order 100, band against band") {
  const int order = 100;
  // The diagonal blocks m, -m carry all the conditions on the polar factors: check the columns of a few orders m.
  const IntervalRule rule = gaussLegendre(order);
  for (const int m : {0, 1, 37, 98}) {
    std::vector<double> gram(order * order);
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double z = rule.nodes[k];
      const auto y = basisAt(order, {std::sqrt((1 - z) * (1 + z)), 0, z});
      for (int l = m; l < order; ++l) {
        for (int j = m; j < order; ++j) gram[l * order + j] += rule.weights[k] * y[index(l, m)] * y[index(j, m)];
      }
    }
    for (int l = m; l < order; ++l) {
      for (int j = m; j < order; ++j) {
        REQUIRE(std::abs(gram[l * order + j] * kPi * (m == 0 ? 2 : 1) - (l == j ? 1 : 0)) < 1e-12);
      }
    }
  }
}
