// The nearest known word to a mistyped one.
#include <catch2/catch.hpp>

#include "cli/suggest.h"

using namespace shbake::cli;

TEST_CASE("the edit distance counts insertions, removals, replacements and exchanges") {
  CHECK(editDistance("", "") == 0);
  CHECK(editDistance("", "bake") == 4);
  CHECK(editDistance("bake", "bake") == 0);
  CHECK(editDistance("bke", "bake") == 1);
  CHECK(editDistance("baake", "bake") == 1);
  CHECK(editDistance("bike", "bake") == 1);
  CHECK(editDistance("bkae", "bake") == 1);
  CHECK(editDistance("kitten", "sitting") == 3);
  CHECK(editDistance("sitting", "kitten") == 3);
}

TEST_CASE("the nearest word is found, and nothing where none is near") {
  const std::vector<std::string> words{"--output", "--order", "--rays", "--transfer"};
  CHECK(nearestWord("--outptu", words) == "--output");
  CHECK(nearestWord("--ordr", words) == "--order");
  CHECK(nearestWord("--ray", words) == "--rays");
  CHECK(nearestWord("--trans", words) == "--transfer");  // an abbreviation, five edits away
  CHECK(nearestWord("--frobnicate", words).empty());
  CHECK(nearestWord("", words).empty());
  CHECK(nearestWord("bkae", {"bake", "info"}) == "bake");
  CHECK(nearestWord("xyz", {"bake", "info"}).empty());
}
