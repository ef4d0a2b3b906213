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
  if (facts->surface.samples > 0) describeSurface(facts->surface, report);
}

}  // namespace shbake::cli
