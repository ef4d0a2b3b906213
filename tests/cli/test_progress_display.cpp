// Progress on a terminal or in a log: the text, and the times of stages.
#include <algorithm>
#include <catch2/catch.hpp>

#include "cli/progress_display.h"

using namespace shbake;
using namespace shbake::cli;

namespace {

ProgressState state(double done, double total, double elapsed) {
  return {.stage = "tracing", .unit = "rays", .done = done, .total = total, .elapsed = elapsed};
}

}  // namespace

TEST_CASE("a bar shows share, rate and time left in the width there is") {
  const std::string bar = progressBar(state(30e6, 120e6, 3), 80);
  CHECK(bar == "tracing  [########-------------------------]   25 %  10.0 M rays/s  9.00 s left");
  CHECK(bar.size() == 79);
}

TEST_CASE("a bar never reaches the last column") {
  for (const int width : {0, 1, 5, 10, 20, 40, 60, 80, 200}) {
    for (const double done : {0.0, 1.0, 50.0, 100.0}) {
      INFO(width << " " << done);
      CHECK(progressBar(state(done, 100, 2), width).size() <= static_cast<std::size_t>(std::max(0, width - 1)));
    }
  }
}

TEST_CASE("a bar fills from nothing to all") {
  CHECK_THAT(progressBar(state(0, 100, 0), 80), Catch::Contains("[----") && Catch::Contains("   0 %"));
  CHECK_THAT(progressBar(state(100, 100, 1), 80), Catch::Contains("####]  100 %"));
}

TEST_CASE("neither rates nor times are guessed from too little") {
  CHECK_THAT(progressBar(state(1, 100, 0.1), 80), !Catch::Contains("left") && !Catch::Contains("/s"));
  CHECK(progressLine(state(0, 100, 10)) == "tracing: 0 %");
}

TEST_CASE("a stage of unknown length shows its count") {
  CHECK(progressLine(state(1234567, 0, 2)) == "tracing: 1,234,567 rays, 617 k rays/s");
  CHECK(progressBar(state(1234567, 0, 2), 80) == "tracing  1,234,567 rays  617 k rays/s");
}

TEST_CASE("stages are told apart by name or by a clock that starts anew") {
  ProgressDisplay display(ProgressDisplay::Style::none, false);
  display.update({.stage = "loading", .unit = "bytes", .done = 0, .total = 10, .elapsed = 0});
  display.update({.stage = "loading", .unit = "bytes", .done = 10, .total = 10, .elapsed = 0.5});
  display.update(state(0, 100, 0));
  display.update(state(100, 100, 2));
  display.update(state(0, 50, 0));
  display.update(state(50, 50, 1));
  CHECK(display.stages().size() == 2);
  display.finish();
  display.update(state(0, 100, 0));  // too late to count
  const auto stages = display.stages();
  REQUIRE(stages.size() == 3);
  CHECK(stages[0].name == "loading");
  CHECK(stages[0].seconds == 0.5);
  CHECK(stages[1].done == 100);
  CHECK(stages[2].seconds == 1);
}
