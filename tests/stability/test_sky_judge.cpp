// The judge finds what is wrong on purpose, and nothing where nothing is.
#include <catch2/catch.hpp>

#include "stability/sky_judge.h"
#include "support/shapes.h"

using namespace shbake;
using namespace shbake::stability;

namespace {

Outcome judge(const SkyCase& c) {
  const Parallel parallel(2);
  Progress progress;
  return judgeSky(c, {parallel, progress, false});
}

}  // namespace

TEST_CASE("a lid nearer than the naive distance is missed by it alone", "[sky_judge]") {
  const Outcome near = judge({shapes::parallelSheets(1e-5, 2), {}, SelfHits::nearOnes, 100});
  CHECK(near.own.failures == 0);
  CHECK(near.naive.cases == 18);
  CHECK(near.naive.failures >= 2);  // at least the middle of each sheet
  const Outcome far = judge({shapes::parallelSheets(1e-2, 2), {}, SelfHits::nearOnes, 100});
  CHECK(far.own.failures == 0);
  CHECK(far.naive.failures == 0);
}

TEST_CASE("no more vertices are judged than were asked for, and each has one verdict", "[sky_judge]") {
  const Mesh mesh = shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 9, 9);
  CHECK(judge({mesh, {}, SelfHits::nearOnes, 7}).own.cases == 7);
  CHECK(judge({mesh, {}, SelfHits::nearOnes, 1000}).own.cases == 100);
}

TEST_CASE("turns are rotations, and number 0 is none", "[sky_judge]") {
  CHECK(shapes::apply(turned(0).rotation, {1, 2, 3}) == Vec3d(1, 2, 3));
  for (int i = 1; i < 8; ++i) {
    CHECK(length(shapes::apply(turned(i).rotation, {1, 2, 3})) == Approx(std::sqrt(14.0)).epsilon(1e-14));
    CHECK(length(shapes::apply(turned(i).rotation, {1, 2, 3}) - Vec3d(1, 2, 3)) > 0.1);
  }
}

TEST_CASE("what a mesh is judged to be does not depend on threads", "[sky_judge]") {
  const SkyCase c{shapes::boxesOnGround(), turned(2), SelfHits::facesOfVertex, 20};
  Progress progress;
  const Parallel one(1), three(3);
  const Outcome a = judgeSky(c, {one, progress, false}), b = judgeSky(c, {three, progress, false});
  CHECK(a.own.failures == b.own.failures);
  CHECK(a.naive.failures == b.naive.failures);
  CHECK(a.own.cases == b.own.cases);
}
