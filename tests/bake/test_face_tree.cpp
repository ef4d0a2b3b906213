// One tree of faces serves rays from whatever places: contacts, hits and shadows are those of a tree of their own.
#include <catch2/catch.hpp>
#include <limits>
#include <utility>

#include "bake/face_tree.h"
#include "bake/point_tracer.h"
#include "bake/support.h"
#include "bake/surface_places.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A floor of two faces and a box that stands on it without sharing a vertex: both have contacts.
LightingPoints boxOnFloor() {
  return pointsOf(
      shapes::merged(shapes::grid({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}), shapes::box({-1, -1, 0}, {1, 1, 2})));
}

std::vector<SurfacePlace> placesOn(const LightingPoints& points, std::size_t count, std::uint64_t seed) {
  Progress progress;
  return drawPlaces(points, areaWeights(points, points.faces.size()), count, seed, progress);
}

bool sameContacts(const Contacts& a, const Contacts& b, std::uint32_t position) {
  return std::ranges::equal(a.of(position), b.of(position)) && a.isClear(position) == b.isClear(position);
}

/// What points from number `first` on see: masks of the sky, then each hit's face and weights.
std::vector<std::uint32_t> seenFrom(const LightingPoints& points, std::size_t first, const RayScene& scene) {
  const DirectionSet directions(64, 2);
  PointTracer tracer(points, scene, directions, 5, true);
  std::vector<std::uint16_t> sky(std::size_t(directions.groups()));
  std::vector<std::uint32_t> seen;
  for (std::size_t p = first; p < points.size(); ++p) {
    std::vector<Hit> hits;
    tracer.look(std::uint32_t(p), sky);
    seen.insert(seen.end(), sky.begin(), sky.end());
    tracer.lookForHits(std::uint32_t(p), sky, hits);
    seen.insert(seen.end(), sky.begin(), sky.end());
    for (const Hit& hit : hits) seen.insert(seen.end(), {hit.face, hit.u, hit.v});
  }
  return seen;
}

}  // namespace

TEST_CASE("places have the contacts that a tree of their own finds", "[face_tree][contact]") {
  for (const LightingPoints& points : {boxOnFloor(), pointsOf(shapes::chessPiece(1))}) {
    const LightingPoints more = withPlaces(points, placesOn(points, 400, 1));
    const Parallel parallel(2);
    Progress progress;
    const FaceTree shared(points, parallel, progress), own(more, parallel, progress);
    CHECK(shared.contact() == own.contact());
    CHECK(shared.longestEdge() == own.longestEdge());
    CHECK(shared.twins() == own.twins());
    const Contacts ofPlaces(more, shared, positionsFrom(more, points.size()), parallel, progress);
    const Contacts ofAll(more, own, parallel, progress), ofPoints(points, shared, parallel, progress);
    std::size_t touching = 0;
    for (std::uint32_t p = 0; p < more.positions.size(); ++p) {
      const bool isPlace = p >= points.positions.size();
      REQUIRE(sameContacts(isPlace ? ofPlaces : ofPoints, ofAll, p));
      touching += isPlace ? ofPlaces.of(p).size() : 0;
    }
    // A place lies on its own face, but for the rounding of its position.
    CHECK(touching > 300);
    CHECK(touching == ofPlaces.size());
  }
}

TEST_CASE("one tree serves several scenes at once", "[face_tree][ray_scene]") {
  const LightingPoints points = boxOnFloor();
  const LightingPoints some = withPlaces(points, placesOn(points, 60, 2)),
                       others = withPlaces(points, placesOn(points, 80, 3));
  const Parallel parallel(1);
  Progress progress;
  const FaceTree tree(points, parallel, progress);
  const Contacts all(points, tree, parallel, progress);
  const Contacts ofSome(some, tree, positionsFrom(some, points.size()), parallel, progress);
  const Contacts ofOthers(others, tree, positionsFrom(others, points.size()), parallel, progress);
  const RayScene sceneOfAll(points, tree, all, kInfinity), sceneOfSome(some, tree, ofSome, kInfinity);
  const RayScene sceneOfOthers(others, tree, ofOthers, kInfinity);
  const auto alone = [&](const LightingPoints& p, std::size_t first) {
    return seenFrom(p, first, RayScene(p, kInfinity, parallel, progress));
  };
  const std::size_t n = points.size();
  CHECK(seenFrom(some, n, sceneOfSome) == alone(some, n));
  CHECK(seenFrom(points, 0, sceneOfAll) == alone(points, 0));
  CHECK(seenFrom(others, n, sceneOfOthers) == alone(others, n));
  CHECK(seenFrom(some, n, sceneOfSome) != seenFrom(others, n, sceneOfOthers));
}

TEST_CASE("a tree stays good where its points are moved", "[face_tree]") {
  LightingPoints points = boxOnFloor();
  const Parallel parallel(1);
  Progress progress;
  const FaceTree tree(points, parallel, progress);
  const Contacts contacts(points, tree, parallel, progress);
  const std::vector<std::uint32_t> before = seenFrom(points, 0, RayScene(points, tree, contacts, kInfinity));
  const LightingPoints moved = std::move(points);
  CHECK(seenFrom(moved, 0, RayScene(moved, tree, contacts, kInfinity)) == before);
}

TEST_CASE("a tree tells what it holds in memory", "[face_tree]") {
  const Parallel parallel(1);
  Progress progress;
  std::size_t last = 0;
  for (const int level : {3, 4, 5}) {
    const LightingPoints points = pointsOf(shapes::icosphere(level));
    const std::size_t bytes = FaceTree(points, parallel, progress).bytes();
    // The leaves of the tree have the corners of each face, of 12 bytes each.
    CHECK(bytes > 36 * points.faces.size());
    CHECK(bytes > 2 * last);
    last = bytes;
  }
}
