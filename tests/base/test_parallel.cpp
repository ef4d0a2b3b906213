// Parallel loops: every item once, sums that do not depend on the number of threads, exceptions that come through.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "base/parallel.h"

using namespace shbake;

TEST_CASE("every item is visited once, in blocks with fixed bounds") {
  for (const int threads : {1, 2, 3, 4}) {
    const Parallel parallel(threads);
    CHECK(parallel.threads() == threads);
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 10007u}) {
      std::vector<std::atomic<int>> visits(count);
      std::atomic<bool> boundsHold = true, workersHold = true;
      parallel.forBlocks(count, 64, [&](std::size_t begin, std::size_t end, int worker) {
        if (begin % 64 != 0 || end != std::min(count, begin + 64)) boundsHold = false;
        if (worker < 0 || worker >= threads) workersHold = false;
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      CHECK(boundsHold);
      CHECK(workersHold);
      CHECK(std::all_of(visits.begin(), visits.end(), [](const auto& v) { return v == 1; }));
    }
  }
}

TEST_CASE("no two blocks run on one worker at once") {
  const Parallel parallel(4);
  std::vector<std::atomic<int>> busy(4);
  std::atomic<bool> alone = true;
  parallel.forBlocks(20000, 10, [&](std::size_t begin, std::size_t end, int worker) {
    if (++busy[worker] != 1) alone = false;
    volatile double work = 0;
    for (std::size_t i = begin; i < end; ++i) work = work + std::sin(double(i));
    --busy[worker];
  });
  CHECK(alone);
}

TEST_CASE("sums are the same bits on any number of threads") {
  constexpr std::size_t kCount = 100003;
  const auto sumOn = [&](int threads) {
    return Parallel(threads).sumBlocks(kCount, 257, [](std::size_t begin, std::size_t end) {
      double sum = 0;
      // Magnitudes from 1e-8 to 1e8, so that another order of adding rounds differently.
      for (std::size_t i = begin; i < end; ++i) sum += (hashUnit(1, i) - 0.5) * std::pow(10.0, 16 * hashUnit(2, i) - 8);
      return sum;
    });
  };
  const double one = sumOn(1);
  for (const int threads : {2, 3, 4, 0}) {
    for (int repeat = 0; repeat < 5; ++repeat) CHECK(sumOn(threads) == one);
  }
  CHECK(Parallel(2).sumBlocks(0, 8, [](std::size_t, std::size_t) { return 1.0; }) == 0);
}

TEST_CASE("an exception in a block stops the loop and reaches the caller as it was thrown") {
  for (const int threads : {1, 4}) {
    const Parallel parallel(threads);
    std::atomic<int> blocks = 0;
    const auto run = [&] {
      parallel.forBlocks(1 << 20, 1, [&](std::size_t begin, std::size_t, int) {
        ++blocks;
        if (begin == 5) throw Error({.file = "mesh", .cause = "bad"});
      });
    };
    CHECK_THROWS_AS(run(), Error);
    CHECK(blocks < (1 << 20));
    std::atomic<int> after = 0;  // the team is still fit for work
    parallel.forBlocks(100, 10, [&](std::size_t, std::size_t, int) { ++after; });
    CHECK(after == 10);
  }
}

TEST_CASE("more threads than cores are granted") {
  const Parallel parallel(4);
  std::set<std::thread::id> seen;
  std::mutex mutex;
  std::condition_variable changed;
  // Four blocks wait for each other, which ends only if four threads run them.
  parallel.forBlocks(4, 1, [&](std::size_t, std::size_t, int) {
    std::unique_lock lock(mutex);
    seen.insert(std::this_thread::get_id());
    changed.notify_all();
    changed.wait_for(lock, std::chrono::seconds(20), [&] { return seen.size() == 4; });
  });
  CHECK(seen.size() == 4);
}

TEST_CASE("0 threads takes the cores there are, and a number out of range is wrong usage") {
  CHECK(Parallel(0).threads() >= 1);
  for (const int threads : {-1, Parallel::kMostThreads + 1}) {
    try {
      const Parallel parallel(threads);
      FAIL("no Error was thrown");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::usage);
    }
  }
}
