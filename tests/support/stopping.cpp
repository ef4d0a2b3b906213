// Work that is stopped from inside: how it ends, and how soon.
#include "support/stopping.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <limits>

#include "base/error.h"

namespace shbake {
namespace {

constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMostStops = 60;

struct Outcome {
  std::vector<ProgressState> reports;
  bool cancelled = false;
};

/// Runs `work` until the report of number `stopAt`, counted from 0.
Outcome runUntil(const std::function<void(Progress&)>& work, std::size_t stopAt) {
  Outcome outcome;
  Progress progress(
      [&](const ProgressState& state) {
        outcome.reports.push_back(state);
        return outcome.reports.size() <= stopAt;
      },
      Progress::Duration::zero());
  try {
    work(progress);
  } catch (const Error& error) {
    outcome.cancelled = error.kind() == ErrorKind::cancelled;
  }
  return outcome;
}

std::vector<std::string> stagesOf(const std::vector<ProgressState>& reports) {
  std::vector<std::string> stages;
  for (const ProgressState& r : reports) {
    if (stages.empty() || stages.back() != r.stage) stages.push_back(r.stage);
  }
  return stages;
}

}  // namespace

void checkStopping(const std::function<void(Progress&)>& work, const std::vector<StageLimit>& limits) {
  const std::vector<ProgressState> whole = runUntil(work, kNever).reports;
  std::vector<std::string> expected;
  for (const StageLimit& limit : limits) expected.push_back(limit.stage);
  REQUIRE(stagesOf(whole) == expected);

  std::size_t stage = 0;
  for (std::size_t i = 1; i < whole.size(); ++i) {
    if (whole[i].stage != whole[i - 1].stage) {
      ++stage;
      continue;
    }
    CAPTURE(whole[i].stage, whole[i].done);
    CHECK(whole[i].done - whole[i - 1].done <= limits[stage].most);
  }

  const std::size_t stops = std::min(kMostStops, whole.size());
  for (std::size_t i = 0; i < stops; ++i) {
    const std::size_t at = i * whole.size() / stops;
    const Outcome outcome = runUntil(work, at);
    CAPTURE(whole[at].stage, whole[at].done);
    CHECK(outcome.cancelled);
    CHECK(outcome.reports.size() == at + 1);
  }
}

}  // namespace shbake
