// The error between the vertices: what finer flat parts bring, curved meshes, black ones, and too short a time.
#include <catch2/catch.hpp>

#include "chart/sweep/surface_study.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

ChartData study(const Mesh& mesh, double seconds) {
  ChartData data;
  data.points = pointsOf(mesh).size();
  Progress progress;
  studySurface(mesh, {.rays = 64, .secondsPerPointRay = 1e-7, .samples = 256}, Deadline(seconds), Parallel(1), progress,
               data);
  return data;
}

}  // namespace

TEST_CASE("finer flat parts err less between their vertices", "[surface_study]") {
  const ChartData data = study(shapes::boxesOnGround(), 3);
  const auto& points = data.surface.points;
  REQUIRE(points.size() >= 4);
  CHECK(points[0].refinement == SurfaceRefinement::none);
  CHECK_FALSE(points[0].fitted);
  CHECK(points[1].fitted);
  CHECK(points[1].cpu > points[0].cpu);
  for (const SurfaceRefinement kind : {SurfaceRefinement::even, SurfaceRefinement::automatic}) {
    const SurfacePoint* last = &points[0];
    for (const SurfacePoint& p : points) {
      if (p.refinement != kind || p.fitted) continue;
      CHECK(p.vertices > last->vertices);
      last = &p;
    }
    REQUIRE(last != &points[0]);
    // Their 95 % intervals apart: not by chance.
    CHECK(last->error.high < points[0].error.low);
  }
  CHECK(data.notes.empty());
}

TEST_CASE("a mesh without flat parts is fitted only, and a note says so", "[surface_study]") {
  const ChartData data = study(shapes::icosphere(2, 0.25), 5);
  REQUIRE(data.surface.points.size() == 2);
  CHECK(data.surface.points[1].fitted);
  REQUIRE(data.notes.size() == 1);
  CHECK_THAT(data.notes[0], Catch::Contains("no part of the mesh is flat"));
}

TEST_CASE("what does not fit the time is left out, and a note says so", "[surface_study]") {
  const ChartData data = study(shapes::boxesOnGround(), 0);
  CHECK(data.surface.rays == 0);
  CHECK(data.surface.points.empty());
  REQUIRE(data.notes.size() == 1);
  CHECK_THAT(data.notes[0], Catch::Contains("would not fit the budget"));
}
