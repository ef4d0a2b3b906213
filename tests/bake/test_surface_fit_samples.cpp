// Places that are traced: the albedo they get, the scale, sets of their own, and points that stay as they were.
#include <array>
#include <catch2/catch.hpp>

#include "bake/closed_forms.h"
#include "bake/support.h"
#include "bake/surface_fit_samples.h"
#include "sh/irradiance.h"

using namespace shbake;
using namespace shbake::testing;

TEST_CASE("places of a floor have its open transfer times the albedo of each channel", "[surface_fit]") {
  const Rgb albedo(0.25f, 0.5f, 0.75f);
  const LightingPoints points = pointsOf(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 3, 3), albedo);
  const BakeOptions options = optionsOf(TransferKind::shadowed, 3, 16);
  const TransferSet baked = bakeAll(points, options).transfer;
  const Parallel parallel(1);
  Progress progress;
  TracedPoints shared(points, parallel, progress);
  PlaceTracer tracer(shared, baked, nullptr, options, parallel, progress);
  const std::vector<SurfacePlace> places =
      drawPlaces(points, areaWeights(points, points.faces.size()), 10, 1, progress);
  const PlaceTransfers traced = tracer.trace(places, 32, std::array<std::uint64_t, 2>{1, 2});
  CHECK(tracer.rays() == 10 * 2 * 32);
  REQUIRE(traced.sets.size() == 2);
  const double norm = sh::unshadowedNorm(3);
  for (std::size_t s = 0; s < places.size(); ++s) {
    CHECK(traced.scale[s] == Approx(1 / (norm * norm * (0.0625 + 0.25 + 0.5625))));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<double> open = openTransfer(3, {0, 0, 1}, 0.25 * double(c + 1));
      for (std::size_t i = 0; i < 9; ++i) {
        CHECK(double(traced.sets[0][s * 27 + c * 9 + i]) == Approx(open[i]).margin(1e-6));
        CHECK(traced.sets[0][s * 27 + c * 9 + i] == Approx(traced.sets[1][s * 27 + c * 9 + i]).margin(1e-6));
      }
    }
  }
}

TEST_CASE("a tracer repeats itself and tells its seeds apart", "[surface_fit]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(0), {0.5f, 0.5f, 0.5f});
  const BakeOptions options = optionsOf(TransferKind::interreflected, 2, 32);
  const TransferSet baked = bakeAll(points, options).transfer;
  const auto traceWith = [&](PlaceTracer& tracer, std::uint64_t seed) {
    Progress progress;
    const auto places = drawPlaces(points, areaWeights(points, points.faces.size()), 40, 1, progress);
    return tracer.trace(places, 32, std::array{seed}).sets[0];
  };
  Progress progress;
  const Parallel one(1), two(2);
  TracedPoints shared(points, one, progress), sharedByTwo(points, two, progress);
  PlaceTracer alone(shared, baked, &baked, options, one, progress);
  PlaceTracer team(sharedByTwo, baked, &baked, options, two, progress);
  PlaceTracer skyOnly(shared, baked, nullptr, options, one, progress);
  const std::vector<float> first = traceWith(alone, 1);
  CHECK(sameBits(first, traceWith(alone, 1)));
  CHECK(sameBits(first, traceWith(team, 1)));
  CHECK_FALSE(sameBits(first, traceWith(alone, 2)));
  // What faces reflect adds to the mean.
  const std::vector<float> sky = traceWith(skyOnly, 1);
  for (std::size_t s = 0; s < 40; ++s) CHECK(first[4 * s] > sky[4 * s] - 1e-6f);
  CHECK_FALSE(sameBits(first, sky));
}
