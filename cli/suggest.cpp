// The nearest known word to a mistyped one, by the restricted Damerau-Levenshtein distance.
#include "cli/suggest.h"

#include <algorithm>
#include <numeric>

namespace shbake::cli {

std::size_t editDistance(std::string_view a, std::string_view b) {
  // Row i holds the distances of a's first i letters to all beginnings of b; two earlier rows are enough.
  std::vector<std::size_t> twoBack, previous(b.size() + 1), row(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t(0));
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], twoBack[j - 2] + 1);
    }
    twoBack = previous;
    previous = row;
  }
  return previous.back();
}

std::string nearestWord(std::string_view typed, const std::vector<std::string>& words) {
  if (typed.empty()) return {};
  for (const std::string& word : words) {
    if (word.starts_with(typed)) return word;
  }
  std::size_t best = typed.size() > 3 ? std::max<std::size_t>(2, typed.size() / 3) : 1;
  std::string nearest;
  for (const std::string& word : words) {
    const std::size_t distance = editDistance(typed, word);
    if (distance < best || (distance == best && nearest.empty())) {
      best = distance;
      nearest = word;
    }
  }
  return nearest;
}

}  // namespace shbake::cli
