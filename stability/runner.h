// Running rows, and saying what came of it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "stability/families.h"

namespace shbake::stability {

struct RunOptions {
  std::string family;  ///< run only this one; empty: all
  bool brief = false;  ///< fewer cases a row
  /// Seconds after which no further row is begun; those left are reported as not run.
  double budget = std::numeric_limits<double>::infinity();
};

/// What became of a row.
struct RowResult {
  const Row* row = nullptr;
  bool ran = false;
  Outcome outcome;
  double seconds = 0;

  /// More of shbake's cases failed than the row allows, or nothing was tried.
  bool exceedsBound() const { return ran && (outcome.own.cases == 0 || outcome.own.rate() > row->bound); }
};

/// Runs the rows in the order of the table. Outcomes do not depend on time or threads, but for rows that the budget
/// leaves out. Progress counts rows. Throws a usage error for an unknown family; cancelled by `progress`.
std::vector<RowResult> runRows(const RunOptions& options, const Parallel& parallel, Progress& progress);

/// The results as a table in Markdown, each family under a heading, for docs/stability.md.
std::string markdownTable(const std::vector<RowResult>& results);

/// A share as a percentage, "0" or "12 of 345 (3.5 %)".
std::string rateText(const Count& count);

}  // namespace shbake::stability
