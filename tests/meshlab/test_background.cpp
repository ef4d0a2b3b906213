// Work beside the window's thread: results, failures and cancelling.
#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <thread>

#include "meshlab_plugin/background.h"

using namespace shbake;
using meshlab::runInBackground;

namespace {

/// Works in small steps until it is cancelled or `steps` are done.
void work(Progress& progress, int steps) {
  progress.begin("working", steps, "steps");
  for (int i = 0; i < steps; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    progress.advance(1);
  }
  progress.end();
}

}  // namespace

TEST_CASE("background: work runs on another thread, polling on this one") {
  const auto here = std::this_thread::get_id();
  std::thread::id worker;
  double seen = 0;
  bool polledHere = true;
  runInBackground(
      [&](Progress& progress) {
        worker = std::this_thread::get_id();
        work(progress, 300);
      },
      [&](const ProgressState& state) {
        polledHere = polledHere && std::this_thread::get_id() == here;
        seen = std::max(seen, state.done);
        return true;
      });
  CHECK(worker != here);
  CHECK(polledHere);
  CHECK(seen > 0);
}

TEST_CASE("background: an exception of the work arrives here") {
  const auto fails = [](Progress&) { throw usageError("cannot be"); };
  CHECK_THROWS_WITH(runInBackground(fails, [](const ProgressState&) { return true; }), "cannot be");
}

TEST_CASE("background: polling cancels the work") {
  std::atomic<bool> finished{false};
  const auto cancel = [&] {
    runInBackground(
        [&](Progress& progress) {
          work(progress, 60000);
          finished = true;
        },
        [](const ProgressState&) { return false; });
  };
  try {
    cancel();
    FAIL("was not cancelled");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::cancelled);
  }
  CHECK_FALSE(finished);
}

TEST_CASE("background: an exception of polling arrives once the work has ended") {
  std::atomic<bool> running{false};
  const auto poll = [](const ProgressState&) -> bool { throw std::runtime_error("the window has gone"); };
  const auto task = [&](Progress& progress) {
    struct Flag {
      std::atomic<bool>& on;
      explicit Flag(std::atomic<bool>& flag) : on(flag) { on = true; }
      ~Flag() { on = false; }
    } flag(running);
    work(progress, 60000);
  };
  CHECK_THROWS_WITH(runInBackground(task, poll), "the window has gone");
  CHECK_FALSE(running);
}
