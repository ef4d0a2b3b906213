// Twins of faces: found where a face comes twice wound both ways, and nowhere else.
#include <catch2/catch.hpp>

#include "bake/face_twins.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

TEST_CASE("the two sides of a doubled sheet are twins of each other", "[face_twins]") {
  const LightingPoints points = pointsOf(shapes::doubledSheet(3), {1, 1, 1}, {.normals = NormalSource::flat});
  Progress progress;
  const std::vector<std::uint32_t> twins = faceTwins(points, progress);
  REQUIRE(twins.size() == points.faces.size());
  for (std::uint32_t f = 0; f < twins.size(); ++f) {
    REQUIRE(twins[f] < twins.size());
    CHECK(twins[f] != f);
    CHECK(twins[twins[f]] == f);
  }
}

TEST_CASE("neighbours, plain duplicates and degenerate faces are no twins", "[face_twins]") {
  for (const Mesh& mesh :
       {shapes::cube(), shapes::duplicateFaces(), shapes::degenerateFaces(), shapes::bicone(500, 1)}) {
    INFO(mesh.source);
    Progress progress;
    CHECK(faceTwins(pointsOf(mesh, {1, 1, 1}, {.normals = NormalSource::flat}), progress).empty());
  }
}
