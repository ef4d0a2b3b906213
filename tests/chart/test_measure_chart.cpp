// The whole measurement: within its budget, cancelled without a trace, and its parts where they are known.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "chart/sweep/advice.h"
#include "chart/sweep/measure_chart.h"
#include "light/synthetic.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

MeasureOptions quick() {
  MeasureOptions o;
  o.mesh = "test";
  o.budget = 1;
  o.sample = 64;
  o.referenceRays = 2048;
  o.sweep.rays = {16, 32, 64, 128};
  return o;
}

ChartData measure(const LightingPoints& points, const MeasureOptions& options) {
  Progress progress;
  return measureChart(points, options, Parallel(1), progress);
}

}  // namespace

TEST_CASE("a chart of a small mesh has all its parts", "[measure_chart]") {
  const LightingPoints points = pointsOf(shapes::redFloorWhiteWall(6));
  MeasureOptions o = quick();
  const Light light = constantLight(kTruncationOrder, {1, 1, 1});
  o.budget = 20;
  o.light = &light;
  o.lightName = "white";
  const ChartData data = measure(points, o);
  CHECK(data.points == points.size());
  REQUIRE(data.curves.size() == allMethods().size());
  for (const MethodCurve& c : data.curves) {
    INFO(c.method->id);
    REQUIRE(c.points.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(c.points[i].rays == 16 << i);
  }
  REQUIRE(data.orders.size() == 8);
  for (std::size_t i = 1; i < 8; ++i) CHECK(data.orders[i].truncation <= data.orders[i - 1].truncation);
  // White light has one band: those above add nothing.
  for (const OrderPoint& p : data.orders) CHECK(*p.lit == 0);
  REQUIRE(data.bounces.rays > 0);
  const auto& b = data.bounces.points;
  for (std::size_t i = 1; i + 1 < b.size(); ++i) CHECK(b[i].error <= b[i - 1].error);
  CHECK(b.back().automatic);
  CHECK(b.back().error < 0.01);
  CHECK(data.advice.size() == 4);
}

TEST_CASE("a convex body has no error of ours, and nothing is reflected", "[measure_chart]") {
  MeasureOptions o = quick();
  o.budget = 60;  // more than it takes: nothing is to be left out
  const ChartData data = measure(pointsOf(shapes::icosphere(2)), o);
  for (const CurvePoint& p : curveOf(data, "shbake")->points) CHECK(p.error < 1e-6);
  CHECK(data.defaults.error < 1e-6);
  for (const BouncePoint& p : data.bounces.points) CHECK(p.error == 0);
  for (const Advice& a : data.advice) {
    CHECK(a.reachable);
    CHECK(a.rays == 16);
    CHECK(a.bounces == 0);
  }
}

TEST_CASE("the budget is kept by measuring less", "[measure_chart]") {
  // What is measured in any case is small here; the machine may be busy with other tests and make all of it slower, so
  // that the bound is loose. Measuring all of this mesh at all rays would take minutes.
  const LightingPoints points = pointsOf(shapes::icosphere(5, 0.25));
  MeasureOptions o = quick();
  o.sweep.rays = MeasureOptions().sweep.rays;
  o.sample = 2048;
  o.referenceRays = 32768;
  o.budget = 2;
  const ChartData data = measure(points, o);
  CHECK(data.seconds < 10);
  CHECK(data.measuredPoints < points.size());
  CHECK_FALSE(data.notes.empty());
}

TEST_CASE("options out of range are refused", "[measure_chart]") {
  const LightingPoints points = pointsOf(shapes::cube());
  MeasureOptions o = quick();
  o.budget = 0.5;
  CHECK_THROWS_AS(measure(points, o), Error);
  o = quick();
  o.sweep.order = 9;
  CHECK_THROWS_AS(measure(points, o), Error);
  o = quick();
  o.sample = 3;
  CHECK_THROWS_AS(measure(points, o), Error);
}

TEST_CASE("a cancelled measurement ends at once and keeps its reference", "[measure_chart]") {
  Folder folder;
  const LightingPoints points = pointsOf(shapes::redFloorWhiteWall(6));
  for (const std::string stage : {"building", "reference", "planning", "measuring", "orders", "reflections"}) {
    MeasureOptions o = quick();
    o.budget = 20;
    o.cache = folder.file("cache");
    bool reached = false;
    Progress progress(
        [&](const ProgressState& s) {
          reached |= s.stage == stage;
          return !reached;
        },
        Progress::Duration(0));
    INFO(stage);
    CHECK_THROWS_AS(measureChart(points, o, Parallel(1), progress), Error);
    CHECK(reached);
    CHECK(folder.files() <= 1);
  }
}

TEST_CASE("advice shares an error out between rays and reflections", "[advice]") {
  ChartData data;
  MethodCurve ours;
  ours.method = &methodNamed("shbake");
  for (int rays = 16; rays <= 4096; rays *= 4) {
    CurvePoint p;
    p.rays = rays;
    p.cpu = rays / 100.0;
    p.error = 1.0 / rays;
    ours.points.push_back(p);
  }
  data.curves.push_back(ours);
  SECTION("without reflections the rays have all of it") {
    const auto advice = adviseSettings(data);
    CHECK(advice[2].rays == 112);  // 1 / 0.01 = 100, in groups of 16
    CHECK(advice[2].cpu == Approx(1.12));
    CHECK_FALSE(advice[2].bounces);
  }
  SECTION("with them a third is theirs, and squares add up") {
    data.bounces.rays = 64;
    for (int b = 0; b < 4; ++b) data.bounces.points.push_back({b, false, std::pow(0.1, b), 1});
    const auto advice = adviseSettings(data);
    CHECK(advice[2].bounces == 3);  // 0.001 is below 0.01 / 3
    CHECK(advice[2].rays == 112);   // 1 / (0.01 sqrt(8) / 3) = 106.1
    CHECK(advice[0].bounces == 2);
  }
  SECTION("what no measured setting reaches is not advised") {
    data.curves[0].points.resize(1);
    CHECK_FALSE(adviseSettings(data)[1].reachable);
  }
}
