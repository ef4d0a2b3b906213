// Directions from the square, and sums over sets of them against sums written out.
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/direct_transfer.h"
#include "base/hash.h"
#include "chart/methods/cosine_direction.h"
#include "sh/basis.h"

using namespace shbake;
using namespace shbake::chart;

TEST_CASE("the map from the square is onto unit vectors above the horizon, with equal shares", "[cosine_direction]") {
  // Of the cosine-weighted hemisphere, the share with z^2 > u is 1 - u, and each quarter of azimuth holds a quarter. On
  // a grid of n x n cell centres, the curves that bound these cross at most 8 n cells.
  const int n = 400;
  int above = 0, quarter = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3d d = cosineDirection((i + 0.5) / n, (j + 0.5) / n);
      REQUIRE(std::abs(dot(d, d) - 1) < 4e-16 * 4);
      REQUIRE(d.z >= 0);
      above += d.z * d.z > 0.3 ? 1 : 0;
      quarter += d.x > 0 && d.y > 0 ? 1 : 0;
    }
  }
  CHECK(std::abs(above / double(n * n) - 0.7) < 8.0 / n);
  CHECK(std::abs(quarter / double(n * n) - 0.25) < 8.0 / n);
  CHECK(cosineDirection(0.5, 0.5) == Vec3d(0, 0, 1));
}

TEST_CASE("a set of given directions sums what is seen, each by its weight", "[cosine_direction]") {
  for (const int rays : {16, 40, 3000}) {
    for (int order = 1; order <= 8; ++order) {
      std::vector<WeightedDirection> given;
      double weights = 0;
      for (int i = 0; i < rays; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        given.push_back({cosineDirection(hashUnit(1, index), hashUnit(2, index)), 1 + hashUnit(3, index)});
        weights += given.back().weight;
      }
      for (WeightedDirection& w : given) w.weight /= weights;
      const DirectionSet set(given, order);
      REQUIRE(set.size() == (rays + 15) / 16 * 16);
      std::vector<double> y(static_cast<std::size_t>(order * order));
      // What is seen by direction: the set has sorted them, and filled up with some of no weight in a place of one.
      const auto sumOf = [&](const auto& isSeen) {
        std::vector<double> sum(y.size());
        for (const WeightedDirection& w : given) {
          if (!isSeen(Vec3f(w.direction))) continue;
          sh::evaluate(order, w.direction, std::span(y));
          for (std::size_t c = 0; c < y.size(); ++c) sum[c] += w.weight * y[c];
        }
        return sum;
      };
      const auto check = [&](const auto& isSeen) {
        std::vector<std::uint16_t> sky(static_cast<std::size_t>(set.groups()));
        for (int i = 0; i < set.size(); ++i) {
          const bool seen = isSeen(Vec3f(set.x()[i], set.y()[i], set.z()[i]));
          sky[static_cast<std::size_t>(i / 16)] |= static_cast<std::uint16_t>(seen ? 1u << (i % 16) : 0u);
        }
        std::vector<float> sum(y.size());
        DirectTransfer(set).evaluate({sky, {0, 0, 1}, 0}, sum);
        const std::vector<double> expected = sumOf(isSeen);
        // 64 groups of up to 17 rows are added in float, each rounded at 2^-24 of at most the sum of |w y| so far; the
        // turn to world axes and the result are rounded once more.
        const double bound = (64 * 17 + 4) * 0x1p-24 * std::sqrt((2 * order - 1) / (4 * 3.14159265358979));
        for (std::size_t c = 0; c < sum.size(); ++c) CHECK(std::abs(static_cast<double>(sum[c]) - expected[c]) < bound);
      };
      check([](const Vec3f& d) { return d.x > 0.2f * d.z || d.y > 0.5f; });
      check([](const Vec3f& d) { return d.x < -0.7f; });
      check([](const Vec3f&) { return true; });  // no control variate: not the exact transfer, but the sum
      check([](const Vec3f&) { return false; });
    }
  }
}
