// The error between the vertices: what rays, fits, finer flat parts and tolerances bring, curved meshes, and too short
// a time.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "chart/methods/cpu_clock.h"
#include "chart/sweep/surface_study.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

ChartData study(const Mesh& mesh, double seconds, const std::string& cache = {}, std::size_t places = 256) {
  ChartData data;
  data.points = pointsOf(mesh).size();
  Progress progress;
  studySurface(mesh, {.rays = 64, .secondsPerPointRay = 1e-7, .places = places, .cache = cache}, Deadline(seconds),
               Parallel(1), progress, data);
  return data;
}

/// The bakes of one kind in the order in which they were measured.
std::vector<SurfacePoint> pointsOfKind(const ChartData& data, SurfaceRefinement refinement, FitKind fit) {
  std::vector<SurfacePoint> points;
  for (const SurfacePoint& p : data.surface.points) {
    if (p.refinement == refinement && p.fit == fit) points.push_back(p);
  }
  return points;
}

}  // namespace

TEST_CASE("finer flat parts err less between their vertices", "[surface_study]") {
  // The first of each kind are there after a second; all would take half a minute.
  const ChartData data = study(shapes::boxesOnGround(), 6);
  const SurfacePoint& first = data.surface.points.at(0);
  CHECK(isDefault(data.surface, first));
  CHECK(std::count_if(data.surface.points.begin(), data.surface.points.end(),
                      [&](const SurfacePoint& p) { return isDefault(data.surface, p); }) == 1);
  for (const SurfaceRefinement kind : {SurfaceRefinement::even, SurfaceRefinement::automatic}) {
    const auto refined = pointsOfKind(data, kind, FitKind::vertex);
    REQUIRE_FALSE(refined.empty());
    std::size_t last = first.vertices;
    for (const SurfacePoint& p : refined) {
      CHECK(p.vertices > last);
      CHECK(p.rays == 64);
      last = p.vertices;
    }
    // Their 95 % intervals apart: not by chance.
    CHECK(refined.back().error.high < first.error.low);
  }
  // What a tolerance asks for is met, as far as other places can tell.
  const auto chosen = pointsOfKind(data, SurfaceRefinement::chosen, FitKind::automatic);
  REQUIRE_FALSE(chosen.empty());
  for (const SurfacePoint& p : chosen) CHECK(p.error.low < p.asked);
}

TEST_CASE("rays rise, and fits stand behind what they are fits of", "[surface_study]") {
  const ChartData data = study(shapes::icosphere(2, 0.25), 60);
  const auto vertex = pointsOfKind(data, SurfaceRefinement::none, FitKind::vertex);
  REQUIRE(vertex.size() == 5);  // 64 is the default, and measured once
  CHECK(vertex[0].rays == 64);
  CHECK(vertex[1].rays == 16);
  for (std::size_t i = 2; i < 5; ++i) CHECK(vertex[i].rays == 64 << (2 * (i - 1)));
  for (const FitKind fit : {FitKind::automatic, FitKind::surface}) {
    const auto fitted = pointsOfKind(data, SurfaceRefinement::none, fit);
    REQUIRE(fitted.size() == vertex.size());
    for (std::size_t i = 0; i < 5; ++i) {
      CHECK(fitted[i].rays == vertex[i].rays);
      // A fit of its own takes as long as the bake again, and more; a glance may be lost in what else a machine does.
      if (fit == FitKind::surface) CHECK(fitted[i].cpu > vertex[i].cpu);
    }
  }
  // The same places judge all, so that 4096 rays err no more than 16 but by the rays' own luck.
  CHECK(vertex[4].error.rms < vertex[1].error.rms);
  CHECK(vertex[4].error.samples == vertex[1].error.samples);
  CHECK(pointsOfKind(data, SurfaceRefinement::even, FitKind::vertex).empty());
  REQUIRE_FALSE(data.notes.empty());
  CHECK_THAT(data.notes[0], Catch::Contains("no part of the mesh is flat"));
}

TEST_CASE("the places are kept for the next time", "[surface_study]") {
  Folder folder;
  const Mesh mesh = shapes::icosphere(2, 0.25);
  // As many as are traced in any case.
  CHECK(study(mesh, 0.1, folder.file("places"), 32).surface.cache == CacheUse::fresh);
  CHECK(folder.files() == 1);
  CHECK(study(mesh, 0.1, folder.file("places"), 32).surface.cache == CacheUse::complete);
}

TEST_CASE("what does not fit the time is left out, and a note says so", "[surface_study]") {
  const ChartData data = study(shapes::boxesOnGround(), 0);
  CHECK(data.surface.rays == 0);
  CHECK(data.surface.points.empty());
  REQUIRE(data.notes.size() == 1);
  CHECK_THAT(data.notes[0], Catch::Contains("would not fit the budget"));
}

TEST_CASE("begun work ends with the time, and with the user's stop at once", "[surface_study]") {
  const Mesh mesh = shapes::icosphere(5, 0.25);
  // The time of this program alone, whatever else the machine does: one thread gets no more than the budget from its
  // beginning to the deadline. Bakes of 10,242 points with 4096 rays would take ten times as much.
  const double before = cpuSeconds();
  const ChartData data = study(mesh, 1);
  CHECK(cpuSeconds() - before < 5);
  REQUIRE_FALSE(data.notes.empty());
  CHECK_THAT(data.notes.back(), Catch::Contains("were left out"));
  ChartData stoppedData;
  stoppedData.points = 10242;
  Progress stopped([](const ProgressState& s) { return s.stage != "surface"; }, Progress::Duration(0));
  CHECK_THROWS_AS(studySurface(mesh, {.rays = 64, .secondsPerPointRay = 1e-7, .places = 256, .cache = {}},
                               Deadline(100), Parallel(1), stopped, stoppedData),
                  Error);
}
