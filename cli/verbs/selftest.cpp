// `shbake selftest`: where methods fail, and how often they do here.
#include <cstdio>

#include "cli/format.h"
#include "cli/options.h"
#include "cli/verb.h"
#include "stability/runner.h"

namespace shbake::cli {
namespace {

using stability::RowResult;

/// Seconds that the short form takes at most before it leaves rows out.
constexpr double kShortBudget = 60;

class Selftest : public Verb {
 public:
  void declare(CLI::App& app) override {
    addSwitch(app, "--short", brief_, "fewer cases a row: some seconds in all, at most about a minute");
    addText(app, {"--family", "NAME", "run one family only: " + familyList()}, family_);
    addSwitch(app, "--markdown", markdown_, "print the table of docs/stability.md instead of a line a row");
  }
  void run(Session& session) override;

 private:
  static std::string familyList();
  void reportRow(const RowResult& result, bool verbose, Report& report) const;

  bool brief_ = false, markdown_ = false;
  std::string family_;
};

std::string Selftest::familyList() {
  std::string list;
  for (const std::string_view name : stability::familyNames()) {
    if (!list.empty()) list += ", ";
    list += name;
  }
  return list;
}

void reportCount(const std::string& key, const stability::Count& count, Report& report) {
  report.data(key + ".cases", static_cast<std::int64_t>(count.cases));
  report.data(key + ".failures", static_cast<std::int64_t>(count.failures));
}

const char* verdict(const RowResult& result) {
  return !result.ran ? "not run" : result.exceedsBound() ? "FAILS" : "ok";
}

/// `text` with blanks behind it up to `width`.
std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

void Selftest::reportRow(const RowResult& result, bool verbose, Report& report) const {
  const stability::Row& row = *result.row;
  const std::string key = std::string("rows.") + row.id;
  report.data(key + ".family", std::string(row.family));
  report.data(key + ".verdict", std::string(verdict(result)));
  report.data(key + ".bound", row.bound);
  report.data(key + ".seconds", result.seconds);
  reportCount(key + ".own", result.outcome.own, report);
  reportCount(key + ".naive", result.outcome.naive, report);
  if (markdown_) return;
  const std::string rates = padded(rateText(result.outcome.own), 22) + "naive " + rateText(result.outcome.naive);
  report.line(row.id, padded(verdict(result), 9) + (result.ran ? rates : ""));
  if (!verbose) return;
  report.line("", std::string(row.place) + ": " + row.seen);
  report.line("", std::string("naive: ") + row.naive);
  report.line("", std::string("shbake: ") + row.done + " (" + row.option + ")");
  report.line("", std::string(row.wrong) + "; " + formatDuration(result.seconds));
}

void Selftest::run(Session& session) {
  const stability::RunOptions options{family_, brief_, brief_ ? kShortBudget : std::numeric_limits<double>::infinity()};
  const std::vector<RowResult> results = stability::runRows(options, session.parallel, session.progress);
  std::size_t ran = 0, failed = 0;
  for (const RowResult& result : results) {
    reportRow(result, session.verbose, session.report);
    ran += result.ran ? 1 : 0;
    failed += result.exceedsBound() ? 1 : 0;
  }
  Report& report = session.report;
  report.data("run", static_cast<std::int64_t>(ran));
  report.data("failed", static_cast<std::int64_t>(failed));
  session.passed = failed == 0;
  if (markdown_) return report.raw(stability::markdownTable(results));
  std::string summary = formatCount(ran - failed) + " of " + formatCount(ran) + " rows within their bounds";
  if (ran < results.size()) summary += ", " + formatCount(results.size() - ran) + " not run for lack of time";
  report.line("", "");
  report.line("rows", summary);
}

}  // namespace

extern const VerbEntry selftestVerb;
const VerbEntry selftestVerb{
    "selftest", "", "try where methods fail, and count how often they do",
    "Bakes and computes in all the places where methods are known to fail, compares with slow double-precision "
    "answers, "
    "and counts the failures of shbake beside those of the usual way: a line a row. Exit code 1 where shbake fails "
    "more "
    "often than it may. Takes up to two minutes; -v explains each row, and docs/stability.md all of them.\n"
    "\n"
    "Examples:\n"
    "  shbake selftest\n"
    "  shbake selftest --short --family contact -v",
    [] { return std::unique_ptr<Verb>(std::make_unique<Selftest>()); }};

}  // namespace shbake::cli
