// Help pages: the wrapping, and that every verb is listed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "cli/help.h"

using namespace shbake::cli;

namespace {

std::size_t longestLine(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

}  // namespace

TEST_CASE("text is broken at spaces before column 80, and lines after the first are indented") {
  std::string text;
  for (int i = 0; i < 60; ++i) text += "word ";
  const std::string result = wrapped(text, 26);
  CHECK(longestLine(std::string(26, ' ') + result) <= 80);
  CHECK_THAT(result, Catch::Contains("\n" + std::string(26, ' ') + "word"));
  CHECK_THAT(result, !Catch::Contains(" \n"));
}

TEST_CASE("short text, paragraphs and examples stay as they are") {
  CHECK(wrapped("one two", 0) == "one two");
  CHECK(wrapped("one\n\ntwo", 0) == "one\n\ntwo");
  CHECK(wrapped("Examples:\n  shbake  bake", 0) == "Examples:\n  shbake  bake");
  CHECK(wrapped("", 4).empty());
}

TEST_CASE("the program's help lists every verb within 80 columns") {
  const std::string help = programHelp();
  CHECK(longestLine(help) <= 80);
  REQUIRE_FALSE(allVerbs().empty());
  for (const VerbEntry* verb : allVerbs()) {
    CHECK_THAT(help, Catch::Contains(std::string("  ") + verb->name) && Catch::Contains(verb->summary));
  }
}
