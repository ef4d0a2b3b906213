// Errors between the vertices at places that are the same for all bakes: found again on refined meshes, in keeping with
// the measurement of the bake itself, kept in a file.
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/baker.h"
#include "bake/surface_error.h"
#include "chart/sweep/surface_judge.h"
#include "mesh/refine.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

const Deadline kLong(1000);
constexpr SurfaceJudgeOptions kQuick{.order = 3, .places = 256, .rays = 512, .cache = {}};

SurfaceJudge judgeOf(const LightingPoints& points, const SurfaceJudgeOptions& options) {
  Progress progress;
  return {points, options, kLong, Parallel(1), progress};
}

/// Transfer that is a linear function of position: the same between vertices, wherever these are.
TransferSet linearTransfer(const PointSurface& surface) {
  TransferSet set;
  set.order = 3;
  for (const Vec3f& p : surface.positions) {
    for (int k = 0; k < 9; ++k) {
      const auto a = static_cast<float>(k);
      set.coefficients.push_back(0.1f * a + 0.3f * p.x - 0.2f * a * p.y + 0.1f * p.z);
    }
  }
  return set;
}

}  // namespace

TEST_CASE("the same function errs the same on the mesh as it is and refined", "[surface_judge]") {
  const Mesh mesh = shapes::boxesOnGround();
  const LightingPoints points = pointsOf(mesh);
  const SurfaceJudge judge = judgeOf(points, kQuick);
  REQUIRE(judge.places() == 256);
  Progress progress;
  const RefinedMesh refined = refineFlatRegions(
      mesh, {}, [](std::uint32_t, const Vec3d&) { return 0.2; }, Parallel(1), progress);
  REQUIRE(refined.mesh.positions.size() > 2 * mesh.positions.size());
  const PointSurface coarse = judge.surfaceOf(points), fine = judge.surfaceOf(pointsOf(refined.mesh));
  const SurfaceError one = judge.errorOf(coarse, linearTransfer(coarse));
  const SurfaceError other = judge.errorOf(fine, linearTransfer(fine));
  // Positions are floats: functions of them agree to some 1e-7 of what they are, near 1, and errors are near 1 too.
  CHECK(one.rms > 0.1);
  CHECK(other.rms == Approx(one.rms).epsilon(1e-5));
  CHECK(other.high == Approx(one.high).epsilon(1e-5));
}

TEST_CASE("a judge agrees with what a bake measures of itself", "[surface_judge]") {
  const LightingPoints points = pointsOf(shapes::boxesOnGround());
  const Parallel parallel(1);
  Progress progress;
  BakeOptions bake;
  bake.kind = TransferKind::shadowed;
  bake.order = 3;
  bake.rays = 64;
  const PointBake baked = bakePoints(points, {}, bake, parallel, progress);
  const SurfaceError own = measureSurfaceError(points, baked.transfer, bake, {.samples = 512}, parallel, progress);
  const SurfaceJudge judge = judgeOf(points, kQuick);
  const SurfaceError judged = judge.errorOf(judge.surfaceOf(points), baked.transfer);
  CHECK(judged.samples == 256);
  CHECK(judged.rays == 512 + 480);
  CHECK(judged.worst >= judged.high);
  // Places are others: both estimate the same mean square, with standard errors by their 95 % intervals.
  const auto square = [](double x) { return x * x; };
  const auto errorOf = [&](const SurfaceError& e) { return (square(e.high) - square(e.rms)) / 1.96; };
  CHECK(std::abs(square(judged.rms) - square(own.rms)) < 4 * std::hypot(errorOf(judged), errorOf(own)));
}

TEST_CASE("albedo with colour is judged channel by channel", "[surface_judge]") {
  const Mesh mesh = shapes::icosphere(2);  // convex: its points are exact, and none of it is shadowed
  Progress progress;
  Albedo red;
  red.values = {{0.8f, 0.4f, 0.2f}};
  const LightingPoints points = makeLightingPoints(mesh, {}, red, progress);
  BakeOptions bake;
  bake.kind = TransferKind::shadowed;
  bake.order = 3;
  bake.rays = 64;
  PointBake baked = bakePoints(points, {}, bake, Parallel(1), progress);
  REQUIRE(baked.transfer.channels == 3);
  const SurfaceJudge judge = judgeOf(points, kQuick);
  const double exact = judge.errorOf(judge.surfaceOf(points), baked.transfer).rms;
  // Chords of the transfer between normals some 0.3 apart: (0.3 / 2)^2 / 2 = 1 %.
  CHECK(exact < 0.02);
  for (std::size_t p = 0; p < baked.transfer.size(); ++p) {
    for (std::size_t k = 0; k < 9; ++k) baked.transfer.coefficients[p * 27 + k] = 0;  // no red at all
  }
  // Of the squares 0.64 + 0.16 + 0.04, all of the first is missing.
  CHECK(judge.errorOf(judge.surfaceOf(points), baked.transfer).rms == Approx(std::sqrt(0.64 / 0.84)).margin(0.02));
}

TEST_CASE("what the places see is kept, and a judge from the file is the same", "[surface_judge]") {
  Folder folder;
  const LightingPoints points = pointsOf(shapes::boxesOnGround());
  SurfaceJudgeOptions options = kQuick;
  options.cache = folder.file("cache");
  const SurfaceJudge first = judgeOf(points, options), second = judgeOf(points, options);
  CHECK(first.cache() == CacheUse::fresh);
  CHECK(second.cache() == CacheUse::complete);
  const PointSurface surface = first.surfaceOf(points);
  const TransferSet set = linearTransfer(surface);
  CHECK(first.errorOf(surface, set) == second.errorOf(surface, set));
  // The time is over: one batch of places in any case, spread over the surface.
  Progress progress;
  const SurfaceJudge few(points, kQuick, Deadline(0), Parallel(1), progress);
  CHECK(few.places() == 32);
}

TEST_CASE("a black mesh has no places to judge", "[surface_judge]") {
  Progress progress;
  Albedo black;
  black.values = {{0, 0, 0}};
  const LightingPoints points = makeLightingPoints(shapes::cube(), {}, black, progress);
  const SurfaceJudge judge = judgeOf(points, kQuick);
  CHECK(judge.places() == 0);
  const PointSurface surface = judge.surfaceOf(points);
  CHECK(judge.errorOf(surface, linearTransfer(surface)).samples == 0);
}
