// Integrals of three spherical harmonics.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/gaunt.h"
#include "sh/quadrature.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("the order-3 table has 83 entries") {
  REQUIRE(GauntTable(3, 3, 3).entries().size() == 83);
}

TEST_CASE("the table equals the integrals, and what it leaves out is zero") {
  for (const auto& [orderA, orderB, orderC] : {std::array{4, 4, 4}, std::array{2, 5, 6}, std::array{6, 3, 1}}) {
    const int a = coefficientCount(orderA), b = coefficientCount(orderB), c = coefficientCount(orderC);
    std::vector<double> dense(a * b * c);
    SphereRule(orderA + orderB + orderC).forEach([&](const Vec3d& d, double weight) {
      const auto y = basisAt(std::max({orderA, orderB, orderC}), d);
      for (int i = 0; i < a; ++i) {
        for (int j = 0; j < b; ++j) {
          for (int k = 0; k < c; ++k) dense[(i * b + j) * c + k] += weight * y[i] * y[j] * y[k];
        }
      }
    });
    const GauntTable table(orderA, orderB, orderC);
    for (const GauntEntry& e : table.entries()) {
      REQUIRE(e.value != 0);
      dense[(e.a * b + e.b) * c + e.c] -= e.value;
    }
    // Each entry at most once, or its place would hold the negative of the integral.
    for (const double rest : dense) REQUIRE(std::abs(rest) < 1e-14);
  }
}

TEST_CASE("one factor of degree 0 gives 1 / sqrt(4 pi)") {
  const GauntTable table(33, 33, 1);
  REQUIRE(table.entries().size() == 33 * 33);
  for (const GauntEntry& e : table.entries()) {
    REQUIRE(e.a == e.b);
    REQUIRE(std::abs(e.value - 1 / std::sqrt(4 * kPi)) < 1e-14);
  }
}

TEST_CASE("entries at high degree are the integrals too") {
  const GauntTable table(33, 3, 33);
  const SphereRule rule(66);
  int checked = 0;
  for (std::size_t n = 0; n < table.entries().size(); n += 997) {
    const GauntEntry& e = table.entries()[n];
    const double value = rule.integrate([&](const Vec3d& d) {
      const auto y = basisAt(33, d);
      return y[e.a] * y[e.b] * y[e.c];
    });
    REQUIRE(std::abs(value - e.value) < 1e-13);
    ++checked;
  }
  REQUIRE(checked > 5);
}

TEST_CASE("orders out of range are refused") {
  REQUIRE_THROWS_AS(GauntTable(0, 1, 1), Error);
  REQUIRE_THROWS_AS(GauntTable(1, GauntTable::kMaxGauntOrder + 1, 1), Error);
}
