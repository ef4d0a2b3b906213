// bench_accuracy: the whole matrix of methods, rays and meshes, as docs/accuracy.md with its charts.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "accuracy_page.h"
#include "base/atomic_file.h"
#include "chart/draw/chart_file.h"
#include "chart/draw/text.h"
#include "chart/sweep/measure_chart.h"
#include "exclusion_cases.h"
#include "light/synthetic.h"
#include "scenes.h"
#include "sh/irradiance.h"

namespace shbake::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> meshes;
  double budget = 90;
  std::size_t sample = 1024;
  std::string docs, cache;
  std::size_t pictures = 4;
  bool print = false;
};

/// Those of the charts first: a scan, boxes, a cavity, a model by hand.
std::vector<std::string> allMeshes(const fs::path& folder) {
  std::vector<std::string> names{"city", "cavity4"};
  for (const char* file : {"stanford-bunny.obj", "spot.obj", "igl_armadillo.obj", "rocker-arm.obj", "fandisk.obj",
                           "suzanne.obj", "teapot.obj", "cow.obj", "igl_decimated-knight.off"}) {
    if (fs::exists(folder / file)) names.push_back((folder / file).string());
  }
  if (names.size() == 2) std::fprintf(stderr, "bench_accuracy: %s is absent: generated meshes only\n", folder.c_str());
  if (names.size() > 4) std::rotate(names.begin(), names.begin() + 2, names.begin() + 3);
  return names;
}

/// The share of the sky that the judged points of each case see, by each method that avoids its start in its own way.
chart::Table exclusionTable() {
  chart::Table table{"", {{"method"}}};
  std::vector<std::string> truth{"truth"};
  const std::vector<ExclusionCase> cases = exclusionCases();
  for (const ExclusionCase& c : cases) {
    table.rows[0].push_back(c.detail);
    truth.push_back(chart::percentText(c.truth));
  }
  table.rows.push_back(truth);
  for (const chart::Method& m : chart::allMethods()) {
    if (m.group == chart::MethodGroup::directions) continue;
    std::vector<std::string> row{m.title};
    for (const ExclusionCase& c : cases) {
      Progress progress;
      const chart::TestBed bed(c.points, Parallel(1), progress);
      const chart::Estimate e = m.estimate(bed, {c.judged, 1, 1024, 1}, progress);
      double seen = 0;
      for (const float t : e.transfer) seen += static_cast<double>(t) / sh::unshadowedNorm(1);
      row.push_back(chart::percentText(seen / static_cast<double>(c.judged.size())));
    }
    table.rows.push_back(row);
  }
  return table;
}

std::string stemOf(const std::string& name) {
  return fs::path(labelOf(name)).stem().string();
}

/// The processor, as the system calls it.
std::string machineName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "an unknown processor";
}

chart::ChartData measure(const std::string& name, const Options& o, const Light& light) {
  const LightingPoints points = namedPoints(name, {0.8f, 0.8f, 0.8f});
  chart::MeasureOptions options;
  options.mesh = stemOf(name);
  options.budget = o.budget;
  options.sample = o.sample;
  if (!o.cache.empty()) options.cache = (fs::path(o.cache) / (stemOf(name) + ".reference")).string();
  options.light = &light;
  options.lightName = "a disc of 5 degrees";
  Progress progress;
  std::fprintf(stderr, "%s ...\n", options.mesh.c_str());
  return chart::measureChart(points, options, Parallel(), progress);
}

/// The command line that measures the same again.
std::string commandOf(const Options& o) {
  std::string command =
      "bench_accuracy --budget " + chart::significantText(o.budget, 6) + " --sample " + std::to_string(o.sample);
  for (const std::string& name : o.meshes) command += " " + labelOf(name);
  return command;
}

void run(const Options& o) {
  AccuracyRun result;
  result.command = commandOf(o);
  result.machine = machineName();
  result.exclusion = exclusionTable();
  const Light light = discLight(chart::kTruncationOrder, {0, 0.6, 0.8}, 5, {1, 1, 1});
  for (const std::string& name : o.meshes) result.meshes.push_back(measure(name, o, light));
  if (o.print) {
    std::fputs(accuracyPage(result).c_str(), stdout);
    return;
  }
  const fs::path docs = o.docs;
  Progress progress;
  for (std::size_t i = 0; i < std::min(o.pictures, result.meshes.size()); ++i) {
    result.pictures.push_back("accuracy_" + result.meshes[i].mesh + ".png");
    chart::writeChart((docs / "images" / result.pictures.back()).string(), result.meshes[i], progress);
  }
  AtomicFile file((docs / "accuracy.md").string());
  file.write(accuracyPage(result));
  file.commit();
}

}  // namespace
}  // namespace shbake::bench

int main(int argc, char** argv) {
  using namespace shbake::bench;
  CLI::App app{"Measures every method on every mesh and writes docs/accuracy.md with its charts"};
  Options o;
  o.docs = SHBAKE_DOCS_DIR;
  app.add_option("meshes", o.meshes, "files or generated meshes; default: all");
  app.add_option("--budget", o.budget, "seconds a mesh");
  app.add_option("--sample", o.sample, "points of each mesh that are measured");
  app.add_option("--docs", o.docs, "folder of accuracy.md and images/");
  app.add_option("--cache", o.cache, "folder that keeps references from run to run; default: none are kept");
  app.add_option("--pictures", o.pictures, "charts of the first meshes that are drawn");
  app.add_flag("--print", o.print, "print the page instead of writing it, without charts");
  CLI11_PARSE(app, argc, argv);
  if (o.meshes.empty()) o.meshes = allMeshes(SHBAKE_SHARED_DIR "/meshes");
  try {
    run(o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_accuracy: %s\n", e.what());
    return 1;
  }
  return 0;
}
