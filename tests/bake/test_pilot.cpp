// The pilot: rays chosen so that the stated error meets the tolerance.
#include <catch2/catch.hpp>

#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

TEST_CASE("the chosen rays meet the tolerance without waste", "[pilot]") {
  for (const Mesh& mesh : {shapes::cornellRoom(4), shapes::city(2, 2, 4), shapes::chessPiece(0)}) {
    const LightingPoints points = pointsOf(mesh);
    int last = 0;
    for (const double tolerance : {0.1, 0.03, 0.01}) {
      BakeOptions options = optionsOf(TransferKind::shadowed, 3, 0);
      options.tolerance = tolerance;
      const PointBake bake = bakeAll(points, options);
      INFO(mesh.source << ", tolerance " << tolerance << ": " << bake.rays << " rays state " << bake.rmsError);
      CHECK(bake.rays % 16 == 0);
      CHECK(bake.rays > last);
      CHECK(bake.rmsError <= tolerance);
      // Errors fall as N^-3/4: a quarter of the rays would state 2.8 times as much.
      if (bake.rays > 64) {
        BakeOptions fewer = options;
        fewer.rays = bake.rays / 4;
        CHECK(bakeAll(points, fewer).rmsError > tolerance);
      }
      last = bake.rays;
    }
  }
}

TEST_CASE("a convex body needs no more than the fewest rays", "[pilot]") {
  BakeOptions options = optionsOf(TransferKind::shadowed, 3, 0);
  options.tolerance = 1e-4;
  const PointBake bake = bakeAll(pointsOf(shapes::icosphere(2)), options);
  CHECK(bake.rmsError == 0);
  CHECK(bake.rays <= 256);
}
