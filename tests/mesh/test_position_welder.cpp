// Equal positions, exactly, against the obvious way to find them.
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/hash.h"
#include "mesh/position_welder.h"

using namespace shbake;

TEST_CASE("numbers follow first appearance, and only equal positions share one") {
  PositionWelder welder;
  CHECK(welder.add({1, 2, 3}) == 0);
  CHECK(welder.add({1, 2, 3.0000000000000004}) == 1);
  CHECK(welder.add({0, 0, -0.0}) == 2);
  CHECK(welder.add({-0.0, 0, 0}) == 2);
  CHECK(welder.add({3, 2, 1}) == 3);
  CHECK(welder.add({1, 2, 3}) == 0);
  CHECK(welder.takePositions().size() == 4);
  CHECK(welder.positions().empty());
  CHECK(welder.add({5, 5, 5}) == 0);
}

TEST_CASE("many positions on a grid agree with a linear search, with and without room made for them") {
  for (const std::size_t expected : {0, 1000}) {
    PositionWelder welder(expected);
    std::vector<Vec3d> found;
    for (std::uint64_t i = 0; i < 3000; ++i) {
      const auto axis = [&](std::uint64_t k) { return double(hashBits(k, i) % 8) / 8 - 0.5; };
      const Vec3d p(axis(1), axis(2), axis(3));
      const auto at = std::find(found.begin(), found.end(), p);
      REQUIRE(welder.add(p) == static_cast<std::uint32_t>(at - found.begin()));
      if (at == found.end()) found.push_back(p);
    }
    CHECK(welder.positions() == found);
  }
}
