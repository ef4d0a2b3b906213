// Counter-based random numbers: known answers, uniformity and independence as statistics.
// Every statistic below is deterministic (fixed seeds); its threshold is the stated quantile of its distribution, so a
// failure means that the generator changed for the worse, not that a run was unlucky.
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/hash.h"

using namespace shbake;

namespace {

/// Quantile 0.9999 of chi-square with `k` degrees of freedom (Wilson, Hilferty, 1931; within 0.1 % for k > 30).
double chiSquareLimit(double k) {
  constexpr double z = 3.719;  // quantile 0.9999 of the normal distribution
  const double a = 2.0 / (9.0 * k);
  return k * std::pow(1.0 - a + z * std::sqrt(a), 3.0);
}

double chiSquare(const std::vector<int>& counts, double expected) {
  double sum = 0;
  for (const int c : counts) sum += (c - expected) * (c - expected) / expected;
  return sum;
}

}  // namespace

TEST_CASE("mixBits is the finaliser of SplitMix64") {
  // The generator's published first outputs for seed 0: state += golden gamma, then the finaliser.
  CHECK(mixBits(0x9E3779B97F4A7C15ull) == 0xE220A8397B1DCDAFull);
  CHECK(mixBits(2 * 0x9E3779B97F4A7C15ull) == 0x6E789E6AA1B965F4ull);
  CHECK(mixBits(3 * 0x9E3779B97F4A7C15ull) == 0x06C45D188009454Full);
}

TEST_CASE("values lie between 0 and 1, and the greatest is below 1") {
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const double u = hashUnit(7, i);
    REQUIRE((u >= 0.0 && u < 1.0));
  }
  CHECK(static_cast<double>(~0ull >> 11) * 0x1p-53 < 1.0);
}

TEST_CASE("values of one stream, and of one index over seeds, are uniform") {
  constexpr int kBins = 256, kSamples = 1 << 18;
  for (const std::uint64_t fixed : {0ull, 1ull, 12345ull, ~0ull}) {
    std::vector<int> overIndex(kBins), overSeed(kBins);
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      ++overIndex[static_cast<std::size_t>(hashUnit(fixed, i) * kBins)];
      ++overSeed[static_cast<std::size_t>(hashUnit(i, fixed) * kBins)];
    }
    INFO("seed or index " << fixed);
    CHECK(chiSquare(overIndex, double(kSamples) / kBins) < chiSquareLimit(kBins - 1));
    CHECK(chiSquare(overSeed, double(kSamples) / kBins) < chiSquareLimit(kBins - 1));
  }
}

TEST_CASE("neighbouring indices and neighbouring seeds are independent") {
  constexpr int kSide = 32, kSamples = 1 << 18;
  std::vector<int> indices(kSide * kSide), seeds(kSide * kSide);
  const auto cell = [](double a, double b) {
    return static_cast<std::size_t>(a * kSide) * kSide + static_cast<std::size_t>(b * kSide);
  };
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    ++indices[cell(hashUnit(3, 2 * i), hashUnit(3, 2 * i + 1))];
    ++seeds[cell(hashUnit(1, i), hashUnit(2, i))];
  }
  const double expected = double(kSamples) / (kSide * kSide);
  CHECK(chiSquare(indices, expected) < chiSquareLimit(kSide * kSide - 1));
  CHECK(chiSquare(seeds, expected) < chiSquareLimit(kSide * kSide - 1));
}

TEST_CASE("every bit of seed and index flips half of the bits") {
  constexpr int kTrials = 4096;
  // A flipped bit's count over trials is binomial: 5 standard deviations over 2 x 64 x 64 counts is a 0.5 % event.
  const double allowed = 5 * std::sqrt(kTrials * 0.25);
  double worst = 0;
  for (int input = 0; input < 128; ++input) {
    std::array<int, 64> flips{};
    for (std::uint64_t t = 0; t < kTrials; ++t) {
      const std::uint64_t seed = t * 77 + 5, bit = 1ull << (input % 64);
      const std::uint64_t changed = input < 64 ? hashBits(seed ^ bit, t) : hashBits(seed, t ^ bit);
      const std::uint64_t difference = hashBits(seed, t) ^ changed;
      for (int b = 0; b < 64; ++b) flips[b] += static_cast<int>(difference >> b & 1);
    }
    for (const int f : flips) worst = std::max(worst, std::abs(f - kTrials * 0.5));
  }
  CHECK(worst < allowed);
}
