// `shbake compare`: how far one baked file is from another.

#include "cli/format.h"
#include "cli/options.h"
#include "cli/surface_option.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

std::int64_t whole(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

std::string statedText(const std::optional<double>& rms) {
  return rms ? formatPercent(*rms) : "nothing";
}

void reportMatches(const TransferComparison& c, Report& report) {
  report.data("vertices.only_in_a", whole(c.unmatchedA));
  report.data("vertices.only_in_b", whole(c.unmatchedB));
  report.data("vertices.black", whole(c.black));
  std::string text = formatCount(c.matched) + " compared";
  if (c.unmatchedA > 0) text += ", " + formatCount(c.unmatchedA) + " of A without a partner";
  if (c.unmatchedB > 0) text += ", " + formatCount(c.unmatchedB) + " of B without a partner";
  if (c.black > 0) text += ", " + formatCount(c.black) + " black";
  report.fact("vertices.compared", whole(c.matched), "vertices", text);
  report.data("order", std::int64_t(c.order));
  report.data("channels", std::int64_t(c.channels));
  report.line("bands", std::to_string(c.order) + ", " + std::to_string(c.channels) +
                           (c.channels == 1 ? " channel" : " channels"));
}

void reportDifference(const TransferComparison& c, Report& report) {
  report.fact("difference.rms", c.rmsError, "difference",
              formatPercent(c.rmsError) + " RMS over the surface, relative to the unshadowed transfer");
  const Vec3d& p = c.worstPosition;
  report.data("difference.worst_vertex", std::int64_t(c.worstVertex));
  report.data("difference.worst_position", std::vector<double>{p.x, p.y, p.z});
  report.fact("difference.worst", c.worstError, "worst",
              formatPercent(c.worstError) + " at vertex " + std::to_string(c.worstVertex) + " of A, (" +
                  formatNumber(p.x, 6) + ", " + formatNumber(p.y, 6) + ", " + formatNumber(p.z, 6) + ")");
  if (c.statedRmsA) report.data("stated.rms_a", *c.statedRmsA);
  if (c.statedRmsB) report.data("stated.rms_b", *c.statedRmsB);
  report.line("stated", statedText(c.statedRmsA) + " by A, " + statedText(c.statedRmsB) + " by B (RMS)");
  if (c.shareBeyondStated) {
    report.fact(
        "stated.share_beyond", *c.shareBeyondStated, "",
        formatPercent(*c.shareBeyondStated) + " of the vertices differ by more than three times what is stated");
  }
  for (const std::string& note : c.notes) report.line("note", note);
  report.data("notes", c.notes);
}

class Compare : public Verb {
 public:
  void declare(CLI::App& app) override {
    addFile(app, "A", a_, "a baked PLY file");
    addFile(app, "B", b_, "the baked PLY file to compare it with: the reference");
    addSurfaceSamples(app, "--surface",
                      "compare A with the light that rays find between its vertices, at random points of its surface",
                      kSurfaceUsage, samples_);
  }
  void run(Session& session) override;

 private:
  static constexpr const char* kSurfaceUsage = "shbake compare A --surface";

  void measureSurface(Session& session) const;

  std::string a_, b_;
  std::size_t samples_ = 0;
};

void Compare::measureSurface(Session& session) const {
  if (a_.empty() || !b_.empty()) {
    throw usageError("--surface measures one file by itself", std::string("usage: ") + kSurfaceUsage);
  }
  const BakedPly baked = readBakedPly(a_, session.progress);
  const SurfaceError surface = measureSurfaceError(baked, samples_, session.parallel, session.progress);
  Report& report = session.report;
  report.data("a", a_);
  if (surface.samples == 0) {
    report.fact("surface.samples", std::int64_t(0), "surface", "not measured: no face has an area and reflects light");
    return;
  }
  describeSurface(surface, report);
  report.line("", "(relative to the unshadowed transfer)");
  const bool stated = baked.facts.rmsError > 0 || baked.facts.rays == 0;
  if (stated) report.data("stated.rms_a", baked.facts.rmsError);
  report.line("stated", stated ? formatPercent(baked.facts.rmsError) + " at the vertices (RMS)" : "nothing");
}

void Compare::run(Session& session) {
  if (samples_ > 0) return measureSurface(session);
  if (b_.empty()) throw usageError("two files are needed", "usage: shbake compare A B");
  const BakedPly a = readBakedPly(a_, session.progress), b = readBakedPly(b_, session.progress);
  const TransferComparison comparison = compareTransfer(a, b, session.progress);
  session.report.data("a", a_);
  session.report.data("b", b_);
  reportMatches(comparison, session.report);
  reportDifference(comparison, session.report);
}

}  // namespace

extern const VerbEntry compareVerb;
const VerbEntry compareVerb{
    "compare", "A B", "tell how far one baked file is from another",
    "Compares the light transfer of two baked files of one mesh, vertex by vertex, matched by position and normal, and "
    "tells the difference relative to the unshadowed transfer of B, beside the errors that the files state. With "
    "--surface, tells how far the transfer of A, "
    "interpolated over its faces, is from the one that is traced there.\n"
    "\n"
    "Examples:\n"
    "  shbake compare quick.ply reference.ply\n"
    "  shbake compare quick.ply --surface",
    [] { return std::unique_ptr<Verb>(std::make_unique<Compare>()); }};

}  // namespace shbake::cli
