// Running rows, and saying what came of it.
#include "stability/runner.h"

#include <chrono>
#include <cstdio>
#include <string_view>

namespace shbake::stability {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

RowResult runRow(const Row& row, bool brief, const Parallel& parallel, Progress& progress) {
  // Bakes within a row have stages of their own, which would take the place of the one that counts rows.
  Progress inner([&](const ProgressState&) { return progress.tryAdvance(0); });
  const auto start = std::chrono::steady_clock::now();
  RowResult result{&row, true, row.measure({parallel, inner, brief}), 0};
  result.seconds = secondsSince(start);
  return result;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share > 0 && share < 0.01 ? "%.2g %%" : "%.3g %%", 100 * share);
  return text;
}

std::string counted(std::size_t n) {
  const std::string digits = std::to_string(n);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace

std::vector<RowResult> runRows(const RunOptions& options, const Parallel& parallel, Progress& progress) {
  const std::vector<const Row*> rows = rowsOf(options.family);
  std::vector<RowResult> results;
  const auto start = std::chrono::steady_clock::now();
  progress.begin("testing", static_cast<double>(rows.size()), "rows");
  for (const Row* row : rows) {
    if (secondsSince(start) > options.budget) {
      results.push_back({row, false, {}, 0});
    } else {
      results.push_back(runRow(*row, options.brief, parallel, progress));
    }
    progress.advance(1);
  }
  progress.end();
  return results;
}

std::string rateText(const Count& count) {
  if (count.failures == 0) return "0 of " + counted(count.cases);
  return counted(count.failures) + " of " + counted(count.cases) + " (" + percent(count.rate()) + ")";
}

std::string markdownTable(const std::vector<RowResult>& results) {
  std::string text;
  std::string_view family;
  const auto cell = [&text](std::string_view words) {
    text += "| ";
    text += words;
    text += ' ';
  };
  for (const RowResult& r : results) {
    const Row& row = *r.row;
    if (row.family != family) {
      if (!family.empty()) text += '\n';
      family = row.family;
      text += "### ";
      text += family;
      text += "\n\n| where | what is seen | the naive way | fails | shbake | fails | allowed | a case | option |\n";
      text += "|---|---|---|---|---|---|---|---|---|\n";
    }
    cell(std::string(row.place) + " (`" + row.id + "`)");
    cell(row.seen);
    cell(row.naive);
    cell(r.ran ? rateText(r.outcome.naive) : "not run");
    cell(row.done);
    cell(r.ran ? rateText(r.outcome.own) : "not run");
    cell(row.bound > 0 ? percent(row.bound) : "none");
    cell(row.wrong);
    cell(row.option);
    text += "|\n";
  }
  return text;
}

}  // namespace shbake::stability
