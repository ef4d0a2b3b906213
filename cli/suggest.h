// The nearest known word to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace shbake::cli {

/// The least number of letters inserted, removed, replaced or exchanged with their neighbour that turns `a` into `b`
/// (Damerau, "A technique for computer detection and correction of spelling errors", 1964; each place edited once).
std::size_t editDistance(std::string_view a, std::string_view b);

/// The word that `typed` was most likely meant to be: the first that begins with it, else the nearest one within a
/// third of its length (at least 2 edits for words longer than 3 letters). Empty when nothing is near.
std::string nearestWord(std::string_view typed, const std::vector<std::string>& words);

}  // namespace shbake::cli
