// Products of functions.
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "sh/conventions.h"
#include "sh/projection.h"
#include "sh/support.h"
#include "sh/triple_product.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("products equal the projection of the pointwise product") {
  for (const auto& [out, orderA, orderB] :
       {std::array{3, 3, 3}, std::array{5, 3, 4}, std::array{7, 4, 4}, std::array{2, 6, 5}}) {
    const auto a = randomCoefficients(orderA, 110), b = randomCoefficients(orderB, 111);
    std::vector<double> product(coefficientCount(out));
    TripleProduct(out, orderA, orderB).apply(a, b, product);
    const auto expected = project(
        out, [&](const Vec3d& d) { return valueAt(orderA, a, d) * valueAt(orderB, b, d); }, orderA + orderB - 2);
    REQUIRE(maxDifference(product, expected) < 1e-13);
  }
}

TEST_CASE("products of high order keep their small terms") {
  const int order = 13;
  const auto a = randomCoefficients(order, 119), b = randomCoefficients(order, 120);
  std::vector<double> product(coefficientCount(order));
  TripleProduct(order, order, order).apply(a, b, product);
  const auto expected = project(
      order, [&](const Vec3d& d) { return valueAt(order, a, d) * valueAt(order, b, d); }, 2 * order - 2);
  // 169 coefficients of size 1 a factor: products reach 100.
  REQUIRE(maxDifference(product, expected) < 1e-12);
}

TEST_CASE("the factored order-3 form equals the table to 1e-14") {
  const TripleProduct table(3, 3, 3);
  for (int trial = 0; trial < 100; ++trial) {
    const auto a = randomCoefficients(3, 112 + trial), b = randomCoefficients(3, 300 + trial);
    std::array<double, 9> fast{}, slow{};
    multiplyOrder3(std::span<const double, 9>(a), std::span<const double, 9>(b), fast);
    table.apply(a, b, slow);
    REQUIRE(maxDifference(fast, slow) < 1e-14);
  }
}

TEST_CASE("the factored form in single precision follows its double twin") {
  const auto a = randomCoefficients(3, 113), b = randomCoefficients(3, 114);
  const std::vector<float> af(a.begin(), a.end()), bf(b.begin(), b.end());
  const std::vector<double> ad(af.begin(), af.end()), bd(bf.begin(), bf.end());
  std::array<float, 9> single{};
  std::array<double, 9> twin{};
  multiplyOrder3(std::span<const float, 9>(af), std::span<const float, 9>(bf), single);
  multiplyOrder3(std::span<const double, 9>(ad), std::span<const double, 9>(bd), twin);
  // At most 20 roundings of sums whose terms stay below 10.
  for (int i = 0; i < 9; ++i) REQUIRE(std::abs(single[i] - twin[i]) < 100 * std::numeric_limits<float>::epsilon());
}

TEST_CASE("products are the same with and without Condon-Shortley phase") {
  auto a = randomCoefficients(3, 115), b = randomCoefficients(3, 116);
  std::array<double, 9> plain{}, phased{};
  multiplyOrder3(std::span<const double, 9>(a), std::span<const double, 9>(b), plain);
  flipCondonShortley(3, a);
  flipCondonShortley(3, b);
  multiplyOrder3(std::span<const double, 9>(a), std::span<const double, 9>(b), phased);
  flipCondonShortley(3, phased);
  REQUIRE(maxDifference(plain, phased) < 1e-15);
}

TEST_CASE("the product with one is the function, and commutes") {
  const int order = 6;
  std::vector<double> one(coefficientCount(order)), ab(one.size()), ba(one.size());
  one[0] = std::sqrt(4 * kPi);
  const auto a = randomCoefficients(order, 117), b = randomCoefficients(order, 118);
  const TripleProduct product(order, order, order);
  product.apply(one, a, ab);
  REQUIRE(maxDifference(ab, a) < 1e-14);
  product.apply(a, b, ab);
  product.apply(b, a, ba);
  REQUIRE(maxDifference(ab, ba) < 1e-14);
}

TEST_CASE("products refuse arrays that do not fit") {
  const TripleProduct product(3, 3, 2);
  std::vector<double> nine(9), four(4), out(9);
  REQUIRE_NOTHROW(product.apply(nine, four, out));
  REQUIRE_THROWS_AS(product.apply(four, four, out), Error);
  REQUIRE_THROWS_AS(product.apply(nine, std::span<const double>(four).first(3), out), Error);
  REQUIRE_THROWS_AS(product.apply(nine, four, std::span<double>(out).first(8)), Error);
}
