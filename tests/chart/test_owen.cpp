// Sobol' points and Owen's scrambling: what makes them what they are, exactly.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <set>

#include "base/hash.h"
#include "chart/methods/owen.h"

using namespace shbake;
using namespace shbake::chart;

namespace {

/// The box of an elementary interval that point i lies in: `bitsX` bits of one coordinate, `bitsY` of the other.
template <class Point>
std::set<std::uint64_t> boxes(int m, int bitsX, const Point& coordinate) {
  std::set<std::uint64_t> all;
  for (std::uint32_t i = 0; i < 1u << m; ++i) {
    const std::uint64_t x = std::uint64_t{coordinate(i, 0)} >> (32 - bitsX);
    const std::uint64_t y = std::uint64_t{coordinate(i, 1)} >> (32 - (m - bitsX));
    all.insert(x << 32 | y);
  }
  return all;
}

}  // namespace

TEST_CASE("2^m points put one into each elementary interval, scrambled or not", "[owen]") {
  // The definition of a (0, m, 2)-net, which Owen's scrambling keeps.
  const int m = 10;
  for (int bitsX = 0; bitsX <= m; ++bitsX) {
    CHECK(boxes(m, bitsX, sobolBits).size() == 1u << m);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const auto scrambled = [&](std::uint32_t i, int dimension) {
        return owenScrambled(sobolBits(i, dimension), hashBits(seed, static_cast<std::uint64_t>(dimension)));
      };
      CHECK(boxes(m, bitsX, scrambled).size() == 1u << m);
    }
  }
}

TEST_CASE("the first points are Sobol's", "[owen]") {
  const double first[][2] = {{0, 0}, {0.5, 0.5}, {0.25, 0.75}, {0.75, 0.25}, {0.125, 0.625}, {0.625, 0.125}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    for (const int d : {0, 1}) CHECK(sobolBits(i, d) * 0x1p-32 == first[i][d]);
  }
}

TEST_CASE("scrambling keeps common leading bits common, and what is below independent of them", "[owen]") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const std::uint32_t a = 0xB1234567u, b = a ^ 0x00000400u;  // alike in the 21 leading bits
    const std::uint32_t difference = owenScrambled(a, seed) ^ owenScrambled(b, seed);
    CHECK(difference >> 10 == 1);  // the first bit that differs stays the first, and differs
  }
}

TEST_CASE("a scrambled point is uniform over the seeds", "[owen]") {
  // Each bit is set with probability 1/2: of n seeds n/2 with a standard deviation of sqrt(n)/2; five of these for 64
  // bits are exceeded with probability 4e-5.
  const int n = 20000;
  for (const std::uint32_t point : {0u, 0x9E3779B9u}) {
    for (int bit = 0; bit < 32; ++bit) {
      int set = 0;
      for (int s = 0; s < n; ++s)
        set += static_cast<int>(owenScrambled(point, static_cast<std::uint64_t>(s)) >> bit & 1);
      CHECK(std::abs(set - n / 2) < 5 * std::sqrt(n) / 2);
    }
  }
}
