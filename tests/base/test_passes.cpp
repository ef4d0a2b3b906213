// Passes: what is counted, in which order things come, and how soon a stop is met.
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "base/passes.h"
#include "support/stopping.h"

using namespace shbake;

namespace {

std::vector<std::uint64_t> randomNumbers(std::size_t count) {
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(hashBits(7, i));
  return numbers;
}

}  // namespace

TEST_CASE("a pass goes over everything once, in order", "[passes]") {
  for (const std::size_t count :
       {std::size_t(0), std::size_t(1), kProgressBlock - 1, kProgressBlock, kProgressBlock + 1}) {
    Progress progress;
    Passes passes(progress, "stage", count, "things", 1);
    std::vector<std::size_t> seen;
    passes.forEach(count, [&](std::size_t i) { seen.push_back(i); });
    passes.end();
    REQUIRE(seen.size() == count);
    for (std::size_t i = 0; i < count; ++i) REQUIRE(seen[i] == i);
  }
}

TEST_CASE("passes of any length count alike, and together as the items of the stage", "[passes]") {
  double done = 0;
  Progress progress(
      [&](const ProgressState& state) {
        done = state.done;
        return true;
      },
      Progress::Duration::zero());
  const std::size_t items = 3 * kProgressBlock;
  Passes passes(progress, "stage", items, "things", 3);
  passes.forEach(10 * kProgressBlock + 7, [](std::size_t) {});
  CHECK(done == Approx(kProgressBlock).epsilon(1e-12));
  passes.forEach(5, [](std::size_t) {});
  CHECK(done == Approx(2 * kProgressBlock).epsilon(1e-12));
  std::vector<std::uint64_t> numbers = randomNumbers(2 * kProgressBlock);
  passes.sort(numbers.begin(), numbers.end(), std::less<>());
  CHECK(done == Approx(items).epsilon(1e-12));
}

TEST_CASE("a pass sorts", "[passes]") {
  for (const std::size_t count : {0, 1, 2, 1000, 100000}) {
    std::vector<std::uint64_t> numbers = randomNumbers(count), expected = numbers;
    std::sort(expected.begin(), expected.end());
    Progress progress;
    Passes passes(progress, "stage", count, "things", 1);
    passes.sort(numbers.begin(), numbers.end(), std::less<>());
    CHECK(numbers == expected);
  }
}

TEST_CASE("passes stop within a block of things, or of comparisons", "[passes]") {
  constexpr std::size_t kCount = 20 * kProgressBlock;
  const auto loops = [](Progress& progress) {
    Passes passes(progress, "loops", kCount, "things", 2);
    for (int i = 0; i < 2; ++i) passes.forEach(kCount, [](std::size_t) {});
    passes.end();
  };
  checkStopping(loops, {{"loops", kProgressBlock / 2}});

  std::size_t comparisons = 0, told = 0, most = 0;
  Progress progress(
      [&](const ProgressState&) {
        most = std::max(most, comparisons - told);
        told = comparisons;
        return true;
      },
      Progress::Duration::zero());
  std::vector<std::uint64_t> numbers = randomNumbers(kCount);
  Passes passes(progress, "sort", kCount, "things", 1);
  passes.sort(numbers.begin(), numbers.end(), [&](std::uint64_t a, std::uint64_t b) {
    ++comparisons;
    return a < b;
  });
  CHECK(most <= kProgressBlock);
  CHECK(comparisons > 10 * kCount);
}
