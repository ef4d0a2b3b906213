// How a transfer came about, as facts of a report.
#include "cli/describe_transfer.h"

#include "cli/format.h"
#include "cli/surface_option.h"

namespace shbake::cli {
namespace {

void describeError(const TransferFacts& facts, Report& report) {
  report.data("error.max", facts.maxError);
  if (facts.rays == 0) {
    report.fact("error.rms", facts.rmsError, "error", "none: closed form");
    return;
  }
  report.fact("error.rms", facts.rmsError, "error",
              formatPercent(facts.rmsError) + " RMS over the surface, " + formatPercent(facts.maxError) +
                  " at the worst point");
  report.line("", "(standard error, relative to the unshadowed transfer)");
}

void describeFit(const FitFacts& fit, Report& report) {
  report.data("fit.smoothed_points", static_cast<std::int64_t>(fit.smoothedPoints));
  report.data("fit.error_before", fit.before);
  report.data("fit.error_after", fit.after);
  std::string text;
  if (fit.fittedPoints > 0) text = formatCount(fit.fittedPoints) + " points fitted to the surface";
  if (fit.smoothedPoints > 0) text += (text.empty() ? "" : ", ") + formatCount(fit.smoothedPoints) + " points smoothed";
  report.fact("fit.points", static_cast<std::int64_t>(fit.fittedPoints), "fit", text);
  report.line("", "(surface error " + formatPercent(fit.before) + " before, " + formatPercent(fit.after) +
                      " after; the stated error is that of the vertices as traced)");
}

}  // namespace

void describeTransfer(const TransferSet& set, const TransferFacts* facts, Report& report) {
  report.data("transfer.order", std::int64_t(set.order));
  report.data("transfer.channels", std::int64_t(set.channels));
  const std::string size = std::to_string(set.order) + (set.order == 1 ? " band, " : " bands, ") +
                           std::to_string(set.coefficientsPerChannel()) + " x " + std::to_string(set.channels) +
                           (set.stride() == 1 ? " coefficient a vertex" : " coefficients a vertex");
  if (facts == nullptr) {
    report.line("transfer", size);
    return;
  }
  const std::string kind = transferName(facts->kind);
  report.fact("transfer.kind", kind, "transfer", kind + ", " + size);
  report.data("transfer.seed", static_cast<std::int64_t>(facts->seed));
  report.data("transfer.tolerance", facts->tolerance);
  report.fact("transfer.rays", std::int64_t(facts->rays), "rays",
              facts->rays == 0 ? "none"
                               : formatCount(static_cast<std::uint64_t>(facts->rays)) + " a point (" + facts->sampler +
                                     ", seed " + std::to_string(facts->seed) + ")");
  if (facts->kind == TransferKind::interreflected) {
    report.data("transfer.converged", facts->bouncesConverged);
    report.fact("transfer.bounces", std::int64_t(facts->bounces), "reflections",
                facts->bouncesConverged ? "all, in " + std::to_string(facts->bounces) + " steps of the solver"
                                        : std::to_string(facts->bounces));
  }
  describeError(*facts, report);
  if (facts->fit.any()) describeFit(facts->fit, report);
  if (facts->surface.samples > 0) describeSurface(facts->surface, report);
}

}  // namespace shbake::cli
