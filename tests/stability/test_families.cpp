// Every row in its short form: shbake keeps its bound, and the naive way does not.
#include <catch2/catch.hpp>
#include <cctype>
#include <set>
#include <string>

#include "stability/families.h"
#include "stability/runner.h"

using namespace shbake;
using namespace shbake::stability;

namespace {

void checkFamily(const std::string& family) {
  const Parallel parallel;
  Progress progress;
  for (const RowResult& result : runRows({.family = family, .brief = true}, parallel, progress)) {
    INFO(result.row->id << ": " << rateText(result.outcome.own) << ", naive " << rateText(result.outcome.naive));
    CHECK_FALSE(result.exceedsBound());
    CHECK(result.outcome.own.cases > 0);
    // A place where the usual way does not fail tells nothing.
    CHECK(result.outcome.naive.failures > 0);
    CHECK(result.outcome.naive.rate() > result.outcome.own.rate());
  }
}

}  // namespace

TEST_CASE("rows about the mathematics", "[families]") {
  checkFamily("sh");
}

TEST_CASE("rows about light", "[families]") {
  checkFamily("light");
}

TEST_CASE("rows about tracing", "[families]") {
  checkFamily("tracing");
}

TEST_CASE("rows about contact", "[families]") {
  checkFamily("contact");
}

TEST_CASE("rows about meshes", "[families]") {
  checkFamily("meshes");
}

TEST_CASE("rows about energy", "[families]") {
  checkFamily("energy");
}

TEST_CASE("rows about scale", "[families]") {
  checkFamily("scale");
}

TEST_CASE("each row has a name of its own, a family and all its texts", "[families]") {
  std::set<std::string> ids;
  std::size_t rows = 0;
  for (const std::string_view family : familyNames()) {
    for (const Row* row : rowsOf(family)) {
      ++rows;
      INFO(row->id);
      CHECK(ids.insert(row->id).second);
      CHECK(row->family == family);
      CHECK((row->bound >= 0 && row->bound <= 1));
      for (const std::string text : {row->place, row->seen, row->naive, row->done, row->option, row->wrong}) {
        CHECK_FALSE(text.empty());
        CHECK(text.find('|') == std::string::npos);  // it stands in a table
        CHECK(text.back() != '.');
      }
      for (const char c : std::string(row->id)) CHECK((std::islower(c) || std::isdigit(c) || c == '-'));
    }
  }
  CHECK(rowsOf("").size() == rows);
  CHECK_THROWS_WITH(rowsOf("nothing"), Catch::Contains("'nothing'") && Catch::Contains("contact"));
}
