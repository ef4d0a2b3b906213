// Progress: what the callback is told and how often, and how it stops the work.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"

using namespace shbake;
using Clock = std::chrono::steady_clock;

namespace {

bool throwsCancelled(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.kind() == ErrorKind::cancelled;
  }
  return false;
}

}  // namespace

TEST_CASE("the beginning and the end of a stage are reported, complete") {
  std::vector<ProgressState> seen;
  Progress progress([&](const ProgressState& state) {
    seen.push_back(state);
    return true;
  });
  progress.begin("tracing", 10, "rays");
  for (int i = 0; i < 9; ++i) progress.advance(1);  // one short: end() rounds up
  progress.end();
  REQUIRE(seen.size() >= 2);
  CHECK(seen.front().stage == "tracing");
  CHECK(seen.front().unit == "rays");
  CHECK(seen.front().done == 0);
  CHECK(seen.back().done == 10);
  CHECK(seen.back().total == 10);
  CHECK(seen.back().elapsed >= 0);
}

TEST_CASE("a stage of unknown length counts without an end") {
  ProgressState last;
  Progress progress([&](const ProgressState& state) {
    last = state;
    return true;
  });
  progress.begin("reading", 0, "bytes");
  progress.advance(7);
  progress.end();
  CHECK(last.total == 0);
  CHECK(last.done == 7);
}

TEST_CASE("work done twice over is never reported as more than all") {
  ProgressState last;
  Progress progress([&](const ProgressState& state) {
    last = state;
    return true;
  });
  progress.begin("tracing", 10, "rays");
  progress.advance(25);
  progress.end();
  CHECK(last.done == 10);
}

TEST_CASE("threads are counted exactly, and reports come one at a time and 50 ms apart") {
  std::atomic<int> inside = 0;
  std::atomic<bool> alone = true;
  std::vector<double> times;
  double done = 0;
  Progress progress([&](const ProgressState& state) {
    if (++inside != 1) alone = false;
    times.push_back(state.elapsed);
    done = state.done;
    --inside;
    return true;
  });
  constexpr int kThreads = 4;
  const auto end = Clock::now() + std::chrono::milliseconds(300);
  std::atomic<int> steps = 0;
  progress.begin("tracing", 0, "rays");
  {
    std::vector<std::jthread> team;
    for (int t = 0; t < kThreads; ++t) {
      team.emplace_back([&] {
        while (Clock::now() < end) {
          progress.advance(1);
          ++steps;
        }
      });
    }
  }
  progress.end();
  CHECK(alone);
  CHECK(done == steps);
  REQUIRE(times.size() >= 4);
  for (std::size_t i = 1; i + 1 < times.size(); ++i) CHECK(times[i] - times[i - 1] > 0.05 - 1e-9);
}

TEST_CASE("without an interval, all counted work is reported") {
  std::vector<double> done;
  Progress progress(
      [&](const ProgressState& state) {
        done.push_back(state.done);
        return true;
      },
      Progress::Duration::zero());
  progress.begin("tracing", 3, "rays");
  for (int i = 0; i < 3; ++i) progress.advance(1);
  progress.end();
  CHECK(done == std::vector<double>{0, 1, 2, 3, 3});
}

TEST_CASE("a callback that returns false stops advance(), tryAdvance(), end() and every later stage") {
  bool goOn = true;
  Progress progress([&](const ProgressState&) { return goOn; });
  progress.begin("tracing", 10, "rays");
  CHECK(progress.tryAdvance(1));
  goOn = false;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  CHECK_FALSE(progress.tryAdvance(1));
  goOn = true;  // too late: cancelled work stays cancelled
  CHECK_FALSE(progress.tryAdvance(1));
  CHECK(throwsCancelled([&] { progress.advance(1); }));
  CHECK(throwsCancelled([&] { progress.end(); }));
  CHECK(throwsCancelled([&] { progress.begin("writing", 1, "bytes"); }));
}

TEST_CASE("cancelling stops a parallel loop soon and comes out as one error") {
  std::atomic<bool> stop = false;
  Progress progress([&](const ProgressState&) { return !stop; });
  progress.begin("tracing", 1e9, "rays");
  Clock::time_point stopped;
  const std::jthread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    stopped = Clock::now();
    stop = true;
  });
  CHECK(throwsCancelled([&] {
    Parallel(2).forBlocks(1'000'000'000, 1000, [&](std::size_t, std::size_t, int) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      progress.advance(1000);
    });
  }));
  CHECK(Clock::now() - stopped < std::chrono::milliseconds(500));  // 50 ms by design; the rest is for a busy machine
}

TEST_CASE("without a callback there is nothing to report and nothing stops") {
  Progress progress;
  progress.begin("tracing", 10, "rays");
  CHECK(progress.tryAdvance(5));
  progress.advance(5);
  progress.end();
}
