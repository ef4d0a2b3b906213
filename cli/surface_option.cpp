// The option that asks for the surface error, and how it is told.
#include "cli/surface_option.h"

#include <vector>

#include "cli/format.h"
#include "cli/options.h"
#include "cli/parse.h"

namespace shbake::cli {

void addSurfaceSamples(CLI::App& app, const std::string& name, const std::string& help, const std::string& example,
                       std::size_t& samples) {
  const std::string count = std::to_string(SurfaceErrorOptions().samples);
  CLI::Option* const added = addOption(
      app, {name, "[SAMPLES]", help + "; 16..1048576 samples, " + count + " where no number is given (default: off)"},
      "", [&samples, example](const std::string& option, const std::string& text) {
        if (text.empty()) {
          samples = SurfaceErrorOptions().samples;
          return;
        }
        // Not a number: most likely a file that follows the option.
        if (text.find_first_not_of("+-0123456789.") != text.npos) {
          throw usageError(option + ": '" + text + "' is not a number of samples",
                           "name the file before the option: " + example);
        }
        samples = static_cast<std::size_t>(
            parseWhole(option, text, SurfaceErrorOptions::kLeastSamples, SurfaceErrorOptions::kMostSamples));
      });
  letValueBeLeftOut(*added);
}

void describeSurface(const SurfaceError& surface, Report& report) {
  const Vec3d& p = surface.worstPosition;
  report.data("surface.samples", static_cast<std::int64_t>(surface.samples));
  report.data("surface.rays", std::int64_t(surface.rays));
  report.data("surface.low", surface.low);
  report.data("surface.high", surface.high);
  report.data("surface.worst", surface.worst);
  report.data("surface.worst_position", std::vector<double>{p.x, p.y, p.z});
  report.fact("surface.rms", surface.rms, "surface",
              formatPercent(surface.rms) + " RMS between the vertices (95 % confidence: " + formatPercent(surface.low) +
                  " to " + formatPercent(surface.high) + ")");
  report.line("", formatPercent(surface.worst) + " at the worst of " + formatCount(surface.samples) + " samples, (" +
                      formatNumber(p.x, 6) + ", " + formatNumber(p.y, 6) + ", " + formatNumber(p.z, 6) + ")");
}

}  // namespace shbake::cli
