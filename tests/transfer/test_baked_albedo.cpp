// The albedo behind a baked file comes from what its facts say.
#include <catch2/catch.hpp>

#include "base/srgb.h"
#include "transfer/baked_albedo.h"

using namespace shbake;

namespace {

BakedPly square() {
  BakedPly baked;
  baked.mesh.positions.resize(5);  // the last belongs to no face
  baked.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return baked;
}

}  // namespace

TEST_CASE("Baked albedo: unknown unless stated") {
  BakedPly baked = square();
  baked.mesh.vertexColors.assign(5, Rgb(1, 1, 1));
  CHECK_FALSE(bakedAlbedo(baked));
}

TEST_CASE("Baked albedo: uniform, and left out") {
  BakedPly baked = square();
  baked.facts.albedo = {true, AlbedoOrigin::uniform, Rgb(0.8f, 0.5f, 0), false};
  CHECK(bakedAlbedo(baked) == std::vector<Rgb>(5, Rgb(0.8f, 0.5f, 0)));
  baked.facts.albedo.included = false;
  CHECK(bakedAlbedo(baked) == std::vector<Rgb>(5, Rgb(1, 1, 1)));
}

TEST_CASE("Baked albedo: vertex colours, decoded as for baking") {
  BakedPly baked = square();
  baked.facts.albedo.origin = AlbedoOrigin::vertexColors;
  CHECK_FALSE(bakedAlbedo(baked));
  baked.mesh.vertexColors.assign(5, Rgb(0.5f, 0, 1));
  baked.mesh.vertexColorEncoding = ColorEncoding::srgb;
  CHECK((*bakedAlbedo(baked))[3] == Rgb(srgbToLinear(0.5f), 0, 1));
  baked.facts.albedo.bytesAreLinear = true;
  CHECK((*bakedAlbedo(baked))[3] == Rgb(0.5f, 0, 1));
  baked.facts.albedo.bytesAreLinear = false;
  baked.mesh.vertexColorEncoding = ColorEncoding::linear;
  baked.mesh.vertexColors[3] = Rgb(0.5f, -1, 3);
  CHECK((*bakedAlbedo(baked))[3] == Rgb(0.5f, 0, 1));
}

TEST_CASE("Baked albedo: face colours go to the vertices of the face") {
  BakedPly baked = square();
  baked.facts.albedo.origin = AlbedoOrigin::faceColors;
  CHECK_FALSE(bakedAlbedo(baked));
  baked.mesh.faceColors = {Rgb(0.25f, 0.5f, 0.75f), Rgb(0.25f, 0.5f, 0.75f)};
  const auto albedo = bakedAlbedo(baked);
  REQUIRE(albedo);
  for (std::size_t v = 0; v < 4; ++v) CHECK((*albedo)[v] == Rgb(0.25f, 0.5f, 0.75f));
  CHECK((*albedo)[4] == Rgb(0, 0, 0));
}
