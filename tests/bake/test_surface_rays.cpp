// Rays from places: each set as a bake traces it, sets of their own, and points that are as before when it is over.
#include <array>
#include <catch2/catch.hpp>

#include "bake/support.h"
#include "bake/surface_rays.h"
#include "base/error.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

std::vector<SurfacePlace> placesOn(const LightingPoints& points, std::size_t count) {
  Progress progress;
  return drawPlaces(points, areaWeights(points, points.faces.size()), count, 1, progress);
}

/// Whether all is the same that places are added to, and the positions are the very array.
bool isAsBefore(const LightingPoints& points, const LightingPoints& before, const Vec3f* positions) {
  return points.positions.data() == positions && sameBits(points.positions, before.positions) &&
         sameBits(points.positionFaces.starts, before.positionFaces.starts) &&
         sameBits(points.pointPosition, before.pointPosition) && sameBits(points.pointNormal, before.pointNormal) &&
         sameBits(points.pointAlbedo, before.pointAlbedo);
}

constexpr std::size_t kStride = 3 * 4;

/// All that a set finds at places, one after another.
std::vector<double> foundBy(const SurfaceRays& rays, const RaySet& set, std::size_t places) {
  std::vector<double> found(places * kStride);
  rays.tracePlaces("tracing", std::array{set}, 3, [&](std::size_t s, const Rgb&, auto transfers) {
    std::copy(transfers[0].begin(), transfers[0].end(), &found[s * kStride]);
  });
  return found;
}

constexpr int kRays = 32, kOrder = 2;

}  // namespace

TEST_CASE("rays from corners find what a bake of the same seed finds", "[surface_rays]") {
  // A box in contact with the floor, and creases: corners whose positions are no other's and such that share them.
  const LightingPoints points =
      pointsOf(shapes::merged(shapes::grid({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}), shapes::box({-1, -1, 0}, {1, 1, 2})));
  const BakeOptions options = optionsOf(TransferKind::shadowed, kOrder, kRays, 7);
  const TransferSet baked = bakeAll(points, options).transfer;
  const Parallel parallel(1);
  Progress progress;
  TracedPoints traced(points, parallel, progress);
  std::vector<std::uint32_t> corners;
  for (std::uint32_t p = 0; p < points.size(); p += 2) corners.push_back(p);
  const SurfaceRays rays(traced, placesOn(points, 10), corners, DirectionSet(kRays, kOrder), options, parallel,
                         progress);
  std::size_t visits = 0;
  rays.traceCorners("tracing", std::array{RaySet{7, nullptr}}, 1, [&](std::size_t i, const Rgb& albedo, auto sets) {
    ++visits;
    CHECK(albedo == points.pointAlbedo[corners[i]]);
    const auto row = baked.at(corners[i], 0);
    // Rounding of one turn of the coefficients instead of four at once.
    for (std::size_t k = 0; k < row.size(); ++k) CHECK(sets[0][k] == Approx(double(row[k])).margin(1e-6));
  });
  CHECK(visits == corners.size());
}

TEST_CASE("each set of rays has its own seed and senders, whatever is traced beside it", "[surface_rays]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(0), {0.5f, 0.25f, 0.75f});
  const BakeOptions options = optionsOf(TransferKind::interreflected, kOrder, kRays);
  const TransferSet baked = bakeAll(points, options).transfer;
  const std::vector<SurfacePlace> places = placesOn(points, 40);
  const std::array sets{RaySet{1, nullptr}, RaySet{2, nullptr}, RaySet{1, &baked}};
  Progress progress;
  const Parallel one(1), three(3);
  TracedPoints traced(points, one, progress), tracedByThree(points, three, progress);
  const SurfaceRays alone(traced, places, {}, DirectionSet(kRays, kOrder), options, one, progress);
  const SurfaceRays team(tracedByThree, places, {}, DirectionSet(kRays, kOrder), options, three, progress);
  CHECK(alone.setSize() == kRays);
  std::array<std::vector<double>, sets.size()> found;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    found[i] = foundBy(alone, sets[i], places.size());
    CHECK(sameBits(found[i], foundBy(team, sets[i], places.size())));
  }
  CHECK_FALSE(sameBits(found[0], found[1]));
  CHECK_FALSE(sameBits(found[0], found[2]));
  std::vector<int> visits(places.size(), 0);
  team.tracePlaces("tracing", sets, 3, [&](std::size_t s, const Rgb& albedo, auto transfers) {
    ++visits[s];
    bool same = albedo == pointAt(points, places[s]).albedo && transfers.size() == sets.size();
    for (std::size_t i = 0; i < sets.size() && same; ++i) {
      same = std::equal(transfers[i].begin(), transfers[i].end(), &found[i][s * kStride]);
    }
    visits[s] += same ? 0 : 100;
  });
  CHECK(visits == std::vector<int>(places.size(), 1));
}

TEST_CASE("places stand among points that may change, and are gone afterwards", "[surface_rays]") {
  LightingPoints points = pointsOf(shapes::chessPiece(0), {0.5f, 0.5f, 0.5f});
  const LightingPoints before = points;
  const BakeOptions options = optionsOf(TransferKind::shadowed, kOrder, kRays);
  const Parallel parallel(1);
  Progress progress;
  TracedPoints traced(points, parallel, progress);
  const TransferSet baked = bakePoints(traced, {}, options, parallel, progress).transfer;
  traced.tree();
  const Vec3f* const positions = points.positions.data();
  std::vector<std::vector<double>> found;
  for (const std::size_t count : {600u, 20u, 600u}) {
    const std::vector<SurfacePlace> places = placesOn(points, count);
    {
      const SurfaceRays rays(traced, places, {}, DirectionSet(kRays, kOrder), options, parallel, progress);
      CHECK(points.size() == before.size() + count);
      found.push_back(foundBy(rays, {3, nullptr}, count));
    }
    REQUIRE(isAsBefore(points, before, positions));
  }
  CHECK(sameBits(found[0], found[2]));
  CHECK(sameBits(bakePoints(traced, {}, options, parallel, progress).transfer.coefficients, baked.coefficients));

  // Points that may not change give the same, and do not change.
  TracedPoints constant(before, parallel, progress);
  const SurfaceRays rays(constant, placesOn(before, 600), {}, DirectionSet(kRays, kOrder), options, parallel, progress);
  CHECK(before.size() == points.size());
  CHECK(sameBits(foundBy(rays, {3, nullptr}, 600), found[0]));
}

TEST_CASE("points are as before where the search for contacts is stopped", "[surface_rays]") {
  LightingPoints points = pointsOf(shapes::chessPiece(0));
  const LightingPoints before = points;
  const Parallel parallel(1);
  Progress progress([](const ProgressState& state) { return state.stage != "searching contacts"; });
  TracedPoints traced(points, parallel, progress);
  traced.tree();
  const Vec3f* const positions = points.positions.data();
  const std::vector<SurfacePlace> places = placesOn(points, 100);
  const BakeOptions options = optionsOf(TransferKind::shadowed, kOrder, kRays);
  CHECK_THROWS_AS(SurfaceRays(traced, places, {}, DirectionSet(kRays, kOrder), options, parallel, progress), Error);
  CHECK(isAsBefore(points, before, positions));
}
