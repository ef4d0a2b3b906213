// The surface error of a baked file: that which its bake measured, or a reason why not.
#include <catch2/catch.hpp>
#include <limits>

#include "base/error.h"
#include "pipeline/bake_mesh.h"
#include "pipeline/baked_surface_error.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

/// Bakes a mesh as a file would hold it, with the surface error measured at 64 points.
BakedPly bakeToPly(const Mesh& mesh, BakeMeshOptions options, const std::vector<Mesh>& blockers = {}) {
  options.surfaceSamples = 64;
  Progress progress;
  BakedMesh baked = bakeMesh(mesh, blockers, options, Parallel(1), progress);
  BakedPly file;
  file.mesh = std::move(baked.mesh);
  file.transfer = std::move(baked.transfer);
  file.facts = std::move(baked.facts);
  file.stated = true;
  return file;
}

SurfaceError measure(const BakedPly& baked, std::size_t samples = 64) {
  Progress progress;
  return measureSurfaceError(baked, samples, Parallel(1), progress);
}

/// Boxes on a ground, in colours where `coloured`. Their coordinates are floats, as those of files.
Mesh scene(bool coloured) {
  Mesh mesh = shapes::boxesOnGround();
  if (coloured) mesh = shapes::colored(mesh, {0.75f, 0.5f, 0.25f});
  for (Vec3d& p : mesh.positions) p = roundedToFloat(p);
  return mesh;
}

BakeMeshOptions optionsOf(TransferKind kind, int bounces = BakeOptions::kBouncesAuto) {
  BakeMeshOptions options;
  options.bake.kind = kind;
  options.bake.order = 3;
  options.bake.rays = 64;
  options.bake.bounces = bounces;
  options.bake.seed = 5;
  return options;
}

}  // namespace

TEST_CASE("a baked file tells the surface error that its bake measured", "[baked_surface_error]") {
  for (const bool coloured : {false, true}) {
    for (const TransferKind kind : {TransferKind::unshadowed, TransferKind::shadowed, TransferKind::interreflected}) {
      for (const int bounces : {1, BakeOptions::kBouncesAuto}) {
        INFO(transferName(kind) << ", " << bounces << " bounces");
        const BakedPly baked = bakeToPly(scene(coloured), optionsOf(kind, bounces));
        CHECK(baked.facts.surface.samples == 64);
        CHECK((baked.facts.surface.rms > 0.01) == (kind != TransferKind::unshadowed));
        CHECK(measure(baked) == baked.facts.surface);
      }
    }
  }
}

TEST_CASE("limits of the bake hold for its surface error", "[baked_surface_error]") {
  BakeMeshOptions options = optionsOf(TransferKind::interreflected);
  const SurfaceError plain = bakeToPly(scene(false), options).facts.surface;
  options.bake.maxDistance = 0.3;
  const BakedPly near = bakeToPly(scene(false), options);
  CHECK(near.facts.maxDistance == 0.3);
  CHECK(measure(near) == near.facts.surface);
  CHECK_FALSE(near.facts.surface == plain);
  // A single sheet that stands on a floor has a back that reflects only then.
  const Mesh sheet = shapes::flipped(shapes::grid({-1, 0, 0}, {2, 0, 0}, {0, 0, 1}));
  const Mesh mesh = shapes::merged(shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), sheet);
  const SurfaceError oneSided = bakeToPly(mesh, optionsOf(TransferKind::interreflected)).facts.surface;
  options = optionsOf(TransferKind::interreflected);
  options.bake.twoSided = true;
  const BakedPly both = bakeToPly(mesh, options);
  CHECK(both.facts.twoSided);
  CHECK(measure(both) == both.facts.surface);
  CHECK_FALSE(both.facts.surface == oneSided);
}

TEST_CASE("blockers cast shadows on samples, which lie on the mesh alone", "[baked_surface_error]") {
  const Mesh floor = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const BakedPly baked =
      bakeToPly(floor, optionsOf(TransferKind::shadowed), {shapes::grid({-0.3, -0.3, 0.2}, {0.6, 0, 0}, {0, 0.6, 0})});
  CHECK(baked.facts.blockers == 1);
  CHECK(baked.facts.surface.rms > 0.01);
  CHECK(baked.facts.surface.worstPosition.z == Approx(0).margin(1e-6));
  CHECK_THROWS_WITH(measure(baked), Catch::Contains("beside 1 blockers") && Catch::Contains("measure while baking"));
}

TEST_CASE("files that do not tell how they were baked are refused", "[baked_surface_error]") {
  const BakedPly good = bakeToPly(scene(true), optionsOf(TransferKind::shadowed));
  const auto refused = [&](const char* why, const auto& spoil) {
    INFO(why);
    BakedPly baked = good;
    baked.mesh.source = "file.ply";
    spoil(baked);
    CHECK_THROWS_WITH(measure(baked), Catch::StartsWith("file.ply: ") && Catch::Contains(why));
  };
  refused("does not tell how", [](BakedPly& b) { b.stated = false; });
  refused("does not tell how", [](BakedPly& b) { b.facts.sampler = "sobol"; });
  refused("does not tell how", [](BakedPly& b) { b.facts.rays = 0; });
  refused("cannot have been baked", [](BakedPly& b) { b.facts.rays = std::numeric_limits<int>::max(); });
  refused("does not tell the albedo", [](BakedPly& b) { b.facts.albedo.origin = AlbedoOrigin::unknown; });
  refused("three channels, but grey", [](BakedPly& b) {
    b.facts.albedo.origin = AlbedoOrigin::uniform;
    b.facts.albedo.uniform = {0.5f, 0.5f, 0.5f};
  });
  CHECK_THROWS_WITH(measure(good, 1), Catch::Contains("surface samples"));
}

TEST_CASE("a black mesh is baked, and its surface error is not", "[baked_surface_error]") {
  BakeMeshOptions options = optionsOf(TransferKind::shadowed);
  options.albedo.source = AlbedoSource::uniform;
  options.albedo.uniform = {};
  options.surfaceSamples = 64;
  Progress progress;
  const BakedMesh baked = bakeMesh(scene(false), {}, options, Parallel(1), progress);
  CHECK(baked.facts.surface.samples == 0);
  REQUIRE_FALSE(baked.warnings.empty());
  CHECK_THAT(baked.warnings.back(), Catch::Contains("was not measured"));
}
