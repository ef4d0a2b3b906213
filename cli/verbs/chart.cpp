// `shbake chart`: speed against accuracy on the user's own mesh, as a picture.
#include <filesystem>

#include "chart/draw/chart_file.h"
#include "chart/draw/gnuplot.h"
#include "chart/draw/surface_text.h"
#include "chart/draw/text.h"
#include "chart/sweep/measure_chart.h"
#include "cli/format.h"
#include "cli/options.h"
#include "cli/verb.h"
#include "cli/view_light.h"

namespace shbake::cli {
namespace {

namespace fs = std::filesystem;

class Chart : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void checkPaths() const;
  LightingPoints pointsOf(const Mesh& mesh, Session& session) const;
  void describe(const chart::ChartData& data, Session& session) const;

  std::string mesh_, output_;
  chart::MeasureOptions options_;
  ViewLightOptions light_;
};

void Chart::declare(CLI::App& app) {
  addFile(app, "MESH", mesh_, "the mesh to measure on: PLY, OBJ, OFF or STL");
  addText(app, {"-o,--output", "FILE", "the chart to write: .html, .svg, .png or .json; required"}, output_);
  addReal(app, {"--budget", "SECONDS", "time to measure, 1..100000; in less time, fewer points and rays are measured"},
          options_.budget, 1, 100000);
  addWhole(app, {"--order", "N", "bands of spherical harmonics in which methods are compared, 1..8"},
           options_.sweep.order, 1, 8);
  light_.declare(app);
}

/// Refuses outputs that cannot be meant, and drawing without what draws, before any work is done.
void Chart::checkPaths() const {
  const std::string usage = "usage: shbake chart MESH -o CHART.html";
  if (mesh_.empty()) throw usageError("no mesh is named", usage);
  if (output_.empty()) throw usageError("no output is named", usage);
  const chart::ChartFormat format = chart::chartFormatOf(output_);
  checkWritable(output_);
  checkWritable(options_.cache);
  checkWritable(options_.surfaceCache);
  if (format != chart::ChartFormat::json) chart::requireGnuplot();
}

LightingPoints Chart::pointsOf(const Mesh& mesh, Session& session) const {
  for (const std::string& sentence : mesh.warnings) session.warn(sentence);
  const ResolvedAlbedo albedo = resolveAlbedo(mesh, {});
  for (const std::string& sentence : albedo.warnings) session.warn(sentence);
  return makeLightingPoints(mesh, {}, albedo.albedo, session.progress);
}

void Chart::run(Session& session) {
  options_.cache = output_ + ".reference";
  options_.surfaceCache = output_ + ".places";
  checkPaths();
  const Mesh mesh = readMesh(mesh_, session.progress);
  const LightingPoints points = pointsOf(mesh, session);
  options_.surface = &mesh;
  const ViewLight view = light_.make(chart::kTruncationOrder, false, session);
  const Light light = view.at(points.frame.centre);
  options_.mesh = fs::path(mesh_).filename().string();
  options_.light = &light;
  options_.lightName = view.description;
  const chart::ChartData data = chart::measureChart(points, options_, session.parallel, session.progress);
  chart::writeChart(output_, data, session.progress);
  session.display.finish();
  describe(data, session);
}

void Chart::describe(const chart::ChartData& data, Session& session) const {
  Report& report = session.report;
  const auto whole = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  report.data("input.file", mesh_);
  report.data("points.all", whole(data.points));
  report.fact("points.measured", whole(data.measuredPoints), "measured",
              formatCount(data.measuredPoints) + " of " + formatCount(data.points) + " lighting points");
  report.fact(
      "reference.noise", data.referenceNoise, "reference",
      std::to_string(data.referenceRays) + " rays a point, twice; its noise is " + formatPercent(data.referenceNoise));
  report.data("default.rays", std::int64_t(data.defaults.rays));
  report.data("default.cpu", data.defaults.cpu);
  report.fact("default.error", data.defaults.error, "default",
              std::to_string(data.defaults.rays) + " rays: " + formatPercent(data.defaults.error) + " in " +
                  formatDuration(data.defaults.cpu) + " of CPU time");
  const std::vector<std::string> advice = chart::adviceSentences(data);
  report.data("advice", advice);
  for (std::size_t i = 0; i < advice.size(); ++i) report.line(i == 0 ? "advice" : "", advice[i]);
  const std::vector<std::string> surface = chart::surfaceSentences(data);
  report.data("surface", surface);
  for (std::size_t i = 0; i < surface.size(); ++i) report.line(i == 0 ? "surface" : "", surface[i]);
  report.data("notes", data.notes);
  for (std::size_t i = 0; i < data.notes.size(); ++i) report.line(i == 0 ? "note" : "", data.notes[i]);
  report.fact("seconds", data.seconds, "time", formatDuration(data.seconds));
  report.data("cache.file", options_.cache);
  report.data("cache.surface", options_.surfaceCache);
  report.fact("output.file", output_, "output",
              output_ + ", references kept in " + options_.cache + " and " + options_.surfaceCache);
}

}  // namespace

extern const VerbEntry chartVerb;
const VerbEntry chartVerb{
    "chart", "MESH -o FILE", "chart speed against accuracy on a mesh",
    "Measures on MESH what settings of shbake and other methods err and cost, against a reference of many rays, and "
    "draws it: error against CPU time for 16 to 4096 rays a point, error against order, error against reflections, "
    "the error between the vertices against CPU time and against their number (by rays, fitted, refined and to "
    "tolerances), with a table of the numbers and the settings to use for 5, 2, 1 and 0.5 %. FILE.reference and "
    "FILE.places keep the references for the next time; work that was stopped goes on there.\n"
    "\n"
    "Examples:\n"
    "  shbake chart bunny.obj -o bunny.html\n"
    "  shbake chart city.ply -o city.png --budget 30 --light clear --sun 30,180",
    [] { return std::unique_ptr<Verb>(std::make_unique<Chart>()); }};

}  // namespace shbake::cli
