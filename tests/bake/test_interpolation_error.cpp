// The error of interpolation alone: no bias by the noise of bakes or rays, agreement with the surface error.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <set>

#include "bake/interpolation_error.h"
#include "bake/support.h"
#include "bake/surface_error.h"
#include "base/error.h"
#include "support/scenes.h"
#include "support/stopping.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

std::vector<SurfacePlace> placesOn(const LightingPoints& points, std::size_t count, std::uint64_t seed) {
  Progress progress;
  return drawPlaces(points, areaWeights(points, points.faces.size()), count, seed, progress);
}

std::vector<double> squaresOf(const LightingPoints& points, const std::vector<SurfacePlace>& places,
                              const BakeOptions& options, int threads = 1) {
  const Parallel parallel(threads);
  Progress progress;
  TracedPoints traced(points, parallel, progress);
  return interpolationSquares(traced, places, options, parallel, progress);
}

/// Two unit squares that meet at right angles in the y axis and face each other, n x n cells each.
Mesh floorAndWall(int n) {
  const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return shapes::merged(shapes::grid({}, x, y, n, n), shapes::grid({}, y, z, n, n));
}

}  // namespace

TEST_CASE("the noise of few rays leaves the error of interpolation without bias", "[interpolation_error]") {
  // 16 rays err by some 20 % at every vertex and place; interpolation on the coarse corner errs by a few per cent.
  const LightingPoints points = pointsOf(floorAndWall(2), {0.8f, 0.5f, 0.2f});
  for (const TransferKind kind : {TransferKind::shadowed, TransferKind::interreflected}) {
    INFO("reflected light: " << (kind == TransferKind::interreflected));
    constexpr int kSeeds = 32;
    Samples few, many;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      const std::vector<SurfacePlace> places = placesOn(points, 256, 1000 + seed);
      const auto meanOf = [&](int rays) {
        const std::vector<double> squares = squaresOf(points, places, optionsOf(kind, 3, rays, seed));
        return std::vector<double>{std::accumulate(squares.begin(), squares.end(), 0.0) / double(squares.size())};
      };
      few.add(meanOf(16));
      many.add(meanOf(1024));
    }
    REQUIRE(std::sqrt(many.mean(0)) > 0.01);
    CHECK(std::abs(few.mean(0) - many.mean(0)) <
          errorLimit(1, kSeeds) * std::hypot(few.standardError(0), many.standardError(0)));
  }
}

TEST_CASE("the error of interpolation is the surface error but for the noise of the bake", "[interpolation_error]") {
  const LightingPoints points = pointsOf(shapes::city(2, 1, 1));
  const BakeOptions options = optionsOf(TransferKind::shadowed, 3, 2048);
  const std::vector<SurfacePlace> places = placesOn(points, 8192, 5);
  BakeOptions probe = options;
  probe.rays = 64;
  const std::vector<double> squares = squaresOf(points, places, probe);
  const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / double(squares.size());
  const Parallel parallel(1);
  Progress progress;
  const SurfaceError whole =
      measureSurfaceError(points, bakeAll(points, options).transfer, options, {8192, 0}, parallel, progress);
  // 2048 rays leave noise below 1 %, which adds in square; both estimates have the interval of as many samples.
  CHECK(std::sqrt(mean) > whole.low - (whole.high - whole.low));
  CHECK(std::sqrt(mean) < whole.high + (whole.high - whole.low));
  CHECK(whole.rms > 0.1);
}

TEST_CASE("convex solids with flat faces interpolate without error", "[interpolation_error]") {
  LightingPointOptions flat;
  flat.normals = NormalSource::flat;
  for (const Mesh& solid : shapes::convexSolids()) {
    INFO(solid.source);
    const LightingPoints points = pointsOf(solid, {1, 1, 1}, flat);
    for (const double e : squaresOf(points, placesOn(points, 64, 1), optionsOf(TransferKind::shadowed, 4, 16))) {
      CHECK(std::abs(e) < 1e-12);
    }
  }
}

TEST_CASE("the error of interpolation does not depend on threads", "[interpolation_error]") {
  const LightingPoints points = pointsOf(shapes::city(2, 1, 2));
  const std::vector<SurfacePlace> places = placesOn(points, 512, 3);
  const BakeOptions options = optionsOf(TransferKind::interreflected, 2, 32);
  CHECK(sameBits(squaresOf(points, places, options, 1), squaresOf(points, places, options, 3)));
}

TEST_CASE("without reflections a probe traces from places and their corners alone", "[interpolation_error]") {
  const LightingPoints points = pointsOf(shapes::city(4, 1, 1));
  const std::vector<SurfacePlace> places = placesOn(points, 16, 3);
  std::set<std::uint32_t> corners;
  for (const SurfacePlace& place : places) {
    corners.insert(points.facePoints[place.face].begin(), points.facePoints[place.face].end());
  }
  REQUIRE(4 * corners.size() < points.size());
  double rays = 0;
  const Parallel parallel(1);
  Progress progress([&](const ProgressState& state) {
    if (state.unit == "rays" && state.done == 0) rays += state.total;
    return true;
  });
  TracedPoints traced(points, parallel, progress);
  interpolationSquares(traced, places, optionsOf(TransferKind::shadowed, 2, 32), parallel, progress);
  CHECK(rays == 2.0 * 32 * double(places.size() + corners.size()));
}

TEST_CASE("probes without rays are refused", "[interpolation_error]") {
  const LightingPoints points = pointsOf(shapes::city(1, 1, 1));
  CHECK_THROWS_AS(squaresOf(points, placesOn(points, 16, 1), optionsOf(TransferKind::unshadowed, 2, 16)), Error);
  CHECK_THROWS_AS(squaresOf(points, placesOn(points, 16, 1), optionsOf(TransferKind::shadowed, 2, 0)), Error);
}
