// What baked points send to places: as many reflections as vertices have, less the one on the way.
#include <catch2/catch.hpp>

#include "bake/baker.h"
#include "bake/senders.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

TEST_CASE("places receive as many reflections as vertices do", "[senders]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(2), {0.5f, 0.5f, 0.5f});
  const Parallel parallel(1);
  Progress progress;
  BakeOptions options = optionsOf(TransferKind::interreflected, 2, 64);
  const auto bake = [&](int bounces) {
    options.bounces = bounces;
    return bakePoints(points, {}, options, parallel, progress).transfer;
  };
  const TransferSet once = bake(1), twice = bake(2);
  REQUIRE(once.coefficients != twice.coefficients);
  options.bounces = 2;
  TracedPoints traced(points, parallel, progress);
  const Senders counted(traced, twice, options, parallel, progress);
  REQUIRE(counted.transfer() != nullptr);
  CHECK(counted.transfer()->coefficients == once.coefficients);

  // The sum of all reflections sends itself.
  const TransferSet all = bake(BakeOptions::kBouncesAuto);
  CHECK(Senders(traced, all, options, parallel, progress).transfer() == &all);
  options.bounces = 0;
  CHECK(Senders(traced, all, options, parallel, progress).transfer() == nullptr);
  CHECK(Senders(traced, all, optionsOf(TransferKind::shadowed, 2, 64), parallel, progress).transfer() == nullptr);
}
