// Samples: each point once, blocks that stay together, prefixes that are spread.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "chart/sweep/sample.h"

using namespace shbake::chart;

TEST_CASE("a sample of all points holds each once", "[sample]") {
  for (const std::size_t count : {1u, 15u, 16u, 17u, 333u, 4096u}) {
    const auto points = samplePoints(count, 1 << 20);
    CHECK(points.size() == count);
    CHECK(std::set<std::uint32_t>(points.begin(), points.end()).size() == count);
    CHECK(*std::max_element(points.begin(), points.end()) == count - 1);
  }
}

TEST_CASE("a sample is blocks of 16 points in a row, at most as many as asked for", "[sample]") {
  const auto points = samplePoints(100000, 1000);
  REQUIRE(points.size() == 992);  // 62 blocks
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(points[i] == points[i / 16 * 16] + i % 16);
}

TEST_CASE("every prefix of 2^k blocks has one block in each of 2^k equal stretches", "[sample]") {
  const std::size_t count = 1 << 16;
  const auto points = samplePoints(count, 1 << 12);
  for (std::size_t blocks = 1; blocks <= points.size() / 16; blocks *= 2) {
    std::set<std::size_t> stretches;
    for (std::size_t b = 0; b < blocks; ++b) stretches.insert(points[b * 16] * blocks / count);
    CHECK(stretches.size() == blocks);
  }
}
