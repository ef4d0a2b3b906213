// Charts as files: JSON by its keys, pages that need nothing else, names, and nothing half written.
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "chart/draw/chart_file.h"
#include "chart/draw/chart_json.h"
#include "chart/draw/page.h"
#include "chart/draw/panels.h"
#include "chart/draw/surface_panels.h"
#include "chart/draw/text.h"
#include "chart/sweep/advice.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

/// Made-up numbers: two methods, orders, reflections.
ChartData example() {
  ChartData data;
  data.mesh = "a <b> & \"c\"";
  data.points = 1000;
  data.faces = 2000;
  data.order = 4;
  data.measuredPoints = 500;
  data.referencePoints = 600;
  data.referenceRays = 32768;
  data.referenceNoise = 1e-4;
  for (const char* id : {"shbake", "green"}) {
    MethodCurve curve;
    curve.method = &methodNamed(id);
    for (int rays = 16; rays <= 256; rays *= 4) {
      CurvePoint p;
      p.rays = rays;
      p.traced = rays;
      p.cpu = rays * (curve.method->group == MethodGroup::ours ? 0.01 : 0.05);
      p.error = 1.0 / rays;
      p.runs = 4;
      curve.points.push_back(p);
    }
    data.curves.push_back(curve);
  }
  data.curves[1].systematic = 0.014;
  data.defaults = data.curves[0].points[1];
  data.defaultTolerance = 0.01;
  for (int n = 1; n <= 8; ++n) data.orders.push_back({n, 0.5 / n, {}, 0.01, 0.1});
  data.bounces = {64, {{0, false, 0.1, 1}, {1, false, 0.01, 1.1}, {3, true, 1e-3, 1.2}}};
  data.surface.rays = 64;
  using enum SurfaceRefinement;
  const auto surface = [](double rms) {
    return SurfaceError{
        .samples = 2048, .rays = 512, .rms = rms, .low = rms * 0.9, .high = rms * 1.1, .worst = 1, .worstPosition = {}};
  };
  data.surface.points = {{none, 0, FitKind::vertex, 64, 400, 1, surface(0.2)},
                         {none, 0, FitKind::automatic, 64, 400, 2, surface(0.15)},
                         {even, 0.25, FitKind::vertex, 64, 1600, 4, surface(0.1)},
                         {automatic, 0.08, FitKind::automatic, 64, 900, 3, surface(0.05)},
                         {none, 0, FitKind::vertex, 16, 400, 0.5, surface(0.3)},
                         {chosen, 0.02, FitKind::automatic, 160, 1200, 6, surface(0.02)},
                         {even, 0.125, FitKind::automatic, 64, 6400, 9, surface(0.01)}};
  data.surfaceAdvice = adviseSurface(data.surface);
  data.advice = {{0.05, true, 32, 0.3, 1}, {0.005, false, 0, 0, {}}};
  data.notes = {"a note"};
  return data;
}

}  // namespace

TEST_CASE("the JSON holds what the chart shows", "[chart_file]") {
  const auto json = nlohmann::json::parse(chartJson(example()));
  CHECK(json["shbake_chart"] == 1);
  CHECK(json["lighting_points"] == 1000);
  CHECK(json["measured_points"] == 500);
  CHECK(json["reference"]["rays"] == 32768);
  CHECK(json["defaults"]["rays"] == 64);
  CHECK(json["defaults"]["tolerance"] == 0.01);
  REQUIRE(json["methods"].size() == 2);
  const auto& green = json["methods"][1];
  CHECK(green["method"] == "green");
  CHECK(green["group"] == "programs");
  CHECK(green["systematic_error"] == 0.014);
  CHECK(json["methods"][0]["systematic_error"].is_null());
  for (const auto& m : json["methods"]) {
    REQUIRE(m["points"].size() == 3);
    for (const auto& p : m["points"]) {
      for (const char* key : {"rays", "traced_rays", "cpu", "cpu_spread", "error", "error_spread", "runs"}) {
        CHECK(p[key].is_number());
      }
      CHECK(p["on_front"] == (m["method"] == "shbake"));
    }
  }
  CHECK(json["orders"].size() == 8);
  CHECK(json["orders"][0]["under_light"].is_null());
  CHECK(json["reflections"]["points"][2]["auto"] == true);
  const auto& defaults = json["defaults"];
  CHECK(defaults["over_front"] == Approx(0.25));  // 256 rays are a quarter as fast, 16 a quarter as exact
  CHECK(defaults["over_front_beyond_chance"] == false);
  REQUIRE(json["surface"]["points"].size() == 7);
  CHECK(json["surface"]["rays"] == 64);
  CHECK(json["surface"]["points"][0]["asked"].is_null());
  CHECK(json["surface"]["points"][0]["default"] == true);
  CHECK(json["surface"]["points"][4]["default"] == false);
  CHECK(json["surface"]["points"][1]["fit"] == "auto");
  CHECK(json["surface"]["points"][1]["rays"] == 64);
  // Dearer and worse than what is finer where the light changes: even edges.
  CHECK(json["surface"]["points"][2]["on_front"] == false);
  CHECK(json["surface"]["points"][3]["on_front"] == true);
  CHECK(json["surface"]["points"][5]["refinement"] == "tolerance");
  CHECK(json["surface"]["advice"][0]["point"] == 5);
  CHECK(json["surface"]["advice"][2]["point"] == 6);
  CHECK(json["surface"]["advice"][3]["point"].is_null());
  CHECK(json["surface"]["points"][2]["refinement"] == "even");
  CHECK(json["surface"]["points"][2]["asked"] == 0.25);
  CHECK(json["surface"]["points"][3]["refinement"] == "auto");
  CHECK(json["surface"]["points"][3]["vertices"] == 900);
  CHECK(json["surface"]["points"][3]["error"] == 0.05);
  CHECK(json["advice"][0]["bounces"] == 1);
  CHECK(json["advice"][1]["rays"].is_null());
  CHECK(json["notes"][0] == "a note");
  ChartData bare = example();
  bare.bounces = {};
  bare.surface = {};
  CHECK(nlohmann::json::parse(chartJson(bare))["surface"].is_null());
  CHECK(nlohmann::json::parse(chartJson(bare))["reflections"].is_null());
}

TEST_CASE("a page needs nothing else and takes text as text", "[chart_file]") {
  const std::string drawn =
      "<?xml version='1.0'?><svg><title>Gnuplot</title><g id=\"a\"/><use xlink:href='#a'/><p d='url(#a)'/></svg>\n";
  const std::string page = chartPage(example(), [&](const Panel&) { return drawn; });
  CHECK(page.find("a &lt;b&gt; &amp; &quot;c&quot;") != std::string::npos);
  CHECK(page.find("<b>") == std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  CHECK(page.find("<?xml") == std::string::npos);
  CHECK(page.find("<script") == std::string::npos);
  CHECK(page.find("Gnuplot") == std::string::npos);
  CHECK(page.find("<title>Error against order</title>") != std::string::npos);
  CHECK(page.find("viewport") != std::string::npos);
  for (const char* name : {"directions", "programs", "orders", "bounces", "surface-time", "surface"}) {
    CHECK(page.find(std::string("id=\"") + name + "-a\"") != std::string::npos);
    CHECK(page.find(std::string("'#") + name + "-a'") != std::string::npos);
    CHECK(page.find(std::string("url(#") + name + "-a)") != std::string::npos);
  }
  CHECK(page.find("use --rays 32 --bounces 1") != std::string::npos);
  CHECK(page.find("Between its 400 vertices the mesh errs 20 %") != std::string::npos);
  CHECK(page.find("For 5 % between the vertices use --tolerance 0.02: it errs 2 % with 1200 vertices, 6.00 s") !=
        std::string::npos);
  CHECK(page.find("For 1 % between the vertices use --refine 0.125 --fit auto") != std::string::npos);
  CHECK(page.find("For 0.5 % between the vertices no setting that was measured is enough") != std::string::npos);
  CHECK(page.find("The least measured") == std::string::npos);  // it is advised already
  CHECK(page.find("Nothing that was measured is both faster and more exact than the default") != std::string::npos);
  CHECK(page.find("For 0.5 % error more rays are needed") != std::string::npos);
  CHECK(inlineSvg("no picture", "x-").empty());
}

TEST_CASE("panels without numbers are left out", "[chart_file]") {
  CHECK(panelsOf(example()).size() == 6);
  ChartData data = example();
  data.bounces = {};
  CHECK(panelsOf(data).size() == 5);
  data.surface = {};
  CHECK(panelsOf(data).size() == 3);
}

TEST_CASE("refined meshes are joined to the mesh as it is, which stands alone where nothing was refined",
          "[chart_file]") {
  const auto placesOf = [](const Panel& panel, const std::string& title) {
    for (const Series& s : panel.series) {
      if (s.title == title) return s.places.size();
    }
    return std::size_t(0);
  };
  ChartData data = example();
  Panel panel = surfaceVerticesPanel(data);
  CHECK(placesOf(panel, "even edges") == 2);
  CHECK(placesOf(panel, "even edges, --fit auto") == 2);
  CHECK(placesOf(panel, "finer where the light changes") == 0);
  CHECK(placesOf(panel, "the same, --fit auto") == 2);
  CHECK_THAT(panel.caption, Catch::Contains("divided by --refine auto and --refine LENGTH"));
  data.surface.points.resize(3);
  panel = surfaceVerticesPanel(data);
  CHECK(placesOf(panel, "even edges") == 2);
  CHECK_THAT(panel.caption, Catch::Contains("divided by --refine LENGTH,"));
  CHECK_THAT(panel.caption, !Catch::Contains("auto, with") && !Catch::Contains("light changes"));
  data.surface.points.resize(2);
  panel = surfaceVerticesPanel(data);
  CHECK(placesOf(panel, "even edges") == 0);
  CHECK(placesOf(panel, "the mesh as it is: the default") == 1);
  CHECK(placesOf(panel, "the mesh as it is, --fit auto") == 1);
  CHECK_THAT(panel.caption, Catch::Contains("The mesh was not refined"));
}

TEST_CASE("the error between the vertices against time has a curve for each kind of bake", "[chart_file]") {
  const Panel panel = surfaceTimePanel(example());
  const auto series = [&](const std::string& title) {
    const auto found =
        std::find_if(panel.series.begin(), panel.series.end(), [&](auto& s) { return s.title == title; });
    REQUIRE(found != panel.series.end());
    return *found;
  };
  const Series rays = series("values of the vertices, by rays");
  REQUIRE(rays.places.size() == 2);
  CHECK(rays.places[0].x == 0.5);  // by rising time, however measured
  CHECK(rays.places[0].y == Approx(30));
  CHECK(series("all chosen, by tolerance").places.size() == 1);
  CHECK(series("Pareto front").places.size() == 6);  // all but even edges, which the finer ones beat
  CHECK(series("default: 64 rays").places.size() == 1);
  CHECK_THAT(panel.caption,
             Catch::Contains("--refine LENGTH and --tolerance") && Catch::Contains("Times of --toleranc"));
  ChartData data = example();
  data.surface.points.resize(2);
  CHECK_THAT(surfaceTimePanel(data).caption,
             Catch::Contains("for --rays and --fit auto.") && !Catch::Contains("--tol"));
}

TEST_CASE("numbers are written as people read them", "[chart_file]") {
  CHECK(percentText(0.05) == "5 %");
  CHECK(percentText(0.005) == "0.5 %");
  CHECK(percentText(0.12345) == "12.3 %");
  CHECK(percentText(12.34) == "1234 %");
  CHECK(significantText(0.0012345, 3) == "0.00123");
  CHECK(significantText(12345, 3) == "12345");
  CHECK(significantText(0, 3) == "0");
  CHECK(fixedText(-0.7777, 2) == "-0.78");
  CHECK(fixedText(-0.001, 2) == "0.00");
}

TEST_CASE("formats go by the name, and what fails leaves the old file", "[chart_file]") {
  CHECK(chartFormatOf("a.HTML") == ChartFormat::html);
  CHECK(chartFormatOf("b/c.svg") == ChartFormat::svg);
  CHECK(chartFormatOf("a.png") == ChartFormat::png);
  CHECK(chartFormatOf("a.json") == ChartFormat::json);
  CHECK_THROWS_WITH(chartFormatOf("a.gif"), Catch::Contains(".html, .svg, .png or .json"));
  Folder folder;
  const std::string path = folder.file("chart.svg");
  std::ofstream(path) << "old";
  Progress stopped([](const ProgressState&) { return false; }, Progress::Duration(0));
  CHECK_THROWS_AS(writeChart(path, example(), stopped), Error);
  std::ifstream in(path);
  CHECK(std::string(std::istreambuf_iterator<char>(in), {}) == "old");
  CHECK(folder.files() == 1);
  Progress progress;
  writeChart(folder.file("chart.json"), example(), progress);
  CHECK(folder.files() == 2);
}
