// Tables of directions: the map from the square, and sums over masks against sums written out.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/hash.h"
#include "chart/methods/direction_table.h"
#include "sh/basis.h"

using namespace shbake;
using namespace shbake::chart;

TEST_CASE("the map from the square is onto unit vectors above the horizon, with equal shares", "[direction_table]") {
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

TEST_CASE("a sum over a mask is the sum over its directions", "[direction_table]") {
  for (const int rays : {16, 40, 3000}) {
    for (int order = 1; order <= 8; ++order) {
      std::vector<WeightedDirection> set;
      for (int i = 0; i < rays; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        set.push_back({cosineDirection(hashUnit(1, index), hashUnit(2, index)), (1 + hashUnit(3, index)) / rays});
      }
      const DirectionTable table(set, order);
      REQUIRE(table.size() == rays);
      // What is summed is known by its direction: the table has sorted the set.
      std::vector<std::uint16_t> sky;
      std::vector<double> expected(static_cast<std::size_t>(order * order)), y(expected.size()), sum(expected.size());
      for (int g = 0; g < table.groups(); ++g) {
        const auto bits =
            static_cast<std::uint16_t>(hashBits(4, static_cast<std::uint64_t>(g)) | (g % 3 == 0 ? 0xFFFF : 0));
        sky.push_back(static_cast<std::uint16_t>(bits & table.activeMask(g)));
        for (int k = 0; k < 16; ++k) {
          if ((sky.back() >> k & 1) == 0) continue;
          const int at = 16 * g + k;
          const auto same = [&](const WeightedDirection& w) {
            return Vec3f(w.direction) == Vec3f(table.x()[at], table.y()[at], table.z()[at]);
          };
          const auto found = std::find_if(set.begin(), set.end(), same);
          REQUIRE(found != set.end());
          sh::evaluate(order, found->direction, std::span(y));
          for (std::size_t c = 0; c < y.size(); ++c) expected[c] += found->weight * y[c];
        }
      }
      table.sum(sky, sum);
      // 64 groups of up to 17 rows are added in float, each rounded at 2^-24 of at most the sum of |w y| so far.
      double bound = 0;
      for (const WeightedDirection& w : set) bound += w.weight;
      bound *= (64 * 17 + 2) * 0x1p-24 * std::sqrt((2 * order - 1) / (4 * 3.14159265358979));
      for (std::size_t c = 0; c < sum.size(); ++c) CHECK(std::abs(sum[c] - expected[c]) < bound);
    }
  }
}
