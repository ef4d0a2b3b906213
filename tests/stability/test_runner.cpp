// Running rows: order, budget, cancelling, bounds, the table.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "stability/runner.h"

using namespace shbake;
using namespace shbake::stability;

namespace {

RowResult resultOf(std::size_t cases, std::size_t failures, double bound) {
  static Row row = *rowsOf("sh").front();
  row.bound = bound;
  RowResult result{&row, true, {}, 0};
  result.outcome.own = {cases, failures};
  return result;
}

}  // namespace

TEST_CASE("a row exceeds its bound when more of its own cases fail, or none was tried", "[runner]") {
  CHECK_FALSE(resultOf(100, 0, 0).exceedsBound());
  CHECK(resultOf(100, 1, 0).exceedsBound());
  CHECK_FALSE(resultOf(100, 1, 0.01).exceedsBound());
  CHECK(resultOf(100, 2, 0.01).exceedsBound());
  CHECK(resultOf(0, 0, 0).exceedsBound());
}

TEST_CASE("rows run in the order of the table, and none after the budget", "[runner]") {
  const Parallel parallel(1);
  Progress progress;
  const std::vector<const Row*> rows = rowsOf("light");
  const std::vector<RowResult> all = runRows({.family = "light", .brief = true}, parallel, progress);
  REQUIRE(all.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(all[i].row == rows[i]);
    CHECK(all[i].ran);
  }
  for (const RowResult& result : runRows({.family = "light", .brief = true, .budget = -1}, parallel, progress)) {
    CHECK_FALSE(result.ran);
    CHECK_FALSE(result.exceedsBound());
  }
}

TEST_CASE("a row can be stopped within its bakes", "[runner]") {
  const Parallel parallel(1);
  int reports = 0;
  Progress progress([&](const ProgressState& state) { return state.stage != "testing" || ++reports < 4; },
                    Progress::Duration(0));
  try {
    runRows({.family = "contact", .brief = true}, parallel, progress);
    FAIL("was not stopped");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::cancelled);
  }
  CHECK(reports == 4);
}

TEST_CASE("the table has a line for each row and says what was not run", "[runner]") {
  RowResult good = resultOf(12345, 0, 0), skipped = good;
  good.outcome.naive = {200, 3};
  skipped.ran = false;
  const std::string table = markdownTable({good, skipped});
  CHECK_THAT(table, Catch::StartsWith("### sh\n\n| where |"));
  CHECK_THAT(table, Catch::Contains("| 0 of 12,345 |") && Catch::Contains("| 3 of 200 (1.5 %) |") &&
                        Catch::Contains("| not run |") && Catch::Contains("| none |"));
  CHECK(std::count(table.begin(), table.end(), '\n') == 6);
}

TEST_CASE("rates are told in three digits, small ones in two", "[runner]") {
  CHECK(rateText({10, 0}) == "0 of 10");
  CHECK(rateText({1000, 1000}) == "1,000 of 1,000 (100 %)");
  CHECK(rateText({3, 1}) == "1 of 3 (33.3 %)");
  CHECK(rateText({1000000, 3}) == "3 of 1,000,000 (0.0003 %)");
}
