// Refinement where the light changes: errors that come down to the target, vertices where they help and nowhere else.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "mesh/mesh_check.h"
#include "pipeline/auto_refine.h"
#include "pipeline/bake_mesh.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

BakeOptions shadowed(int order = 3) {
  BakeOptions bake;
  bake.kind = TransferKind::shadowed;
  bake.order = order;
  return bake;
}

AutoRefinement refine(const Mesh& mesh, double target, const BakeOptions& bake = shadowed(),
                      std::size_t maxVertices = 1'000'000, int threads = 1) {
  const Parallel parallel(threads);
  Progress progress;
  AutoRefineOptions options;
  options.target = target;
  options.maxVertices = maxVertices;
  TracedScene scene(makeScenePoints(mesh, {}, {}, {}, progress), parallel, progress);
  return refineWhereLightChanges(mesh, {}, scene, {}, {}, bake, options, parallel, progress);
}

/// The surface error of a bake of so many rays that interpolation rules.
SurfaceError surfaceOf(const Mesh& mesh, BakeOptions bake) {
  BakeMeshOptions options;
  options.bake = bake;
  options.bake.rays = 1024;
  options.bake.seed = 77;
  options.surfaceSamples = 8192;
  const Parallel parallel(1);
  Progress progress;
  return bakeMesh(mesh, {}, options, parallel, progress).facts.surface;
}

/// A floor of two triangles and a box that stands on it without sharing a vertex.
Mesh boxOnFloor() {
  Mesh box = shapes::box({-1, -1, 0}, {1, 1, 2});
  return shapes::merged(shapes::grid({-8, -8, 0}, {16, 0, 0}, {0, 16, 0}), box);
}

}  // namespace

TEST_CASE("the error of interpolation comes down to the target", "[auto_refine]") {
  const Mesh mesh = boxOnFloor();
  REQUIRE(surfaceOf(mesh, shadowed()).rms > 0.1);
  for (const double target : {0.08, 0.04}) {
    const AutoRefinement refined = refine(mesh, target);
    INFO("target " << target << ", " << refined.refined.mesh.positions.size() << " vertices");
    CHECK(refined.end == RefineEnd::met);
    CHECK(refined.before > 0.1);
    // The estimate may scatter by some per cent, and 1024 rays leave some noise.
    const SurfaceError surface = surfaceOf(refined.refined.mesh, shadowed());
    CHECK(surface.low < 1.1 * target);
    CHECK(surface.high > 0.5 * target);
  }
}

TEST_CASE("vertices gather where the light changes", "[auto_refine]") {
  const Mesh mesh = boxOnFloor();
  const AutoRefinement refined = refine(mesh, 0.01);
  std::size_t near = 0, far = 0;
  for (const Vec3d& p : refined.refined.mesh.positions) {
    if (p.z != 0) continue;
    const double distance = std::max(std::abs(p.x), std::abs(p.y));
    if (distance < 2) ++near;
    if (distance > 4) ++far;
  }
  // Within 2 of the middle lies 1/16 of the floor, beyond 4 lie 3/4: equal numbers are 12 times as dense.
  CHECK(12 * near > 5 * far);
  // What the finest edges would take everywhere.
  const double even = 256 / (std::sqrt(3.0) / 2 * refined.shortest * refined.shortest);
  CHECK(double(refined.refined.mesh.positions.size()) < even / 4);
}

TEST_CASE("the foot of a box darkens nothing beside it", "[auto_refine]") {
  const Mesh mesh = refine(boxOnFloor(), 0.1).refined.mesh;
  BakeMeshOptions options;
  options.bake = shadowed(1);
  options.bake.rays = 1024;
  const Parallel parallel(1);
  Progress progress;
  const BakedMesh baked = bakeMesh(mesh, {}, options, parallel, progress);
  const auto sky = [&](std::uint32_t v) {
    return double(baked.transfer.coefficients[v]) / baked.transfer.coefficients[0];  // a corner of the floor sees all
  };
  // Beside a box, the floor sees more than half the sky; under it, nothing.
  double least = 1;
  std::size_t found = 0;
  for (int i = 0; i < 400; ++i) {
    const double t = -1 + 2 * (i % 100 + 0.5) / 100, out = 1.01;
    const Vec3d place = std::array{Vec3d(t, out, 0), Vec3d(t, -out, 0), Vec3d(out, t, 0), Vec3d(-out, t, 0)}[i / 100];
    for (const Triangle& face : mesh.triangles) {
      const Vec3d a = mesh.positions[face[0]], b = mesh.positions[face[1]], c = mesh.positions[face[2]];
      const double area = cross(b - a, c - a).z;
      const double u = cross(c - b, place - b).z / area, v = cross(a - c, place - c).z / area;
      if (a.z + b.z + c.z != 0 || area <= 0 || u < 0 || v < 0 || u + v > 1) continue;
      least = std::min(least, u * sky(face[0]) + v * sky(face[1]) + (1 - u - v) * sky(face[2]));
      ++found;
    }
  }
  CHECK(found >= 400);
  CHECK(least > 0.5 - 3 * baked.facts.maxError);
}

TEST_CASE("an evenly lit surface gets no vertices", "[auto_refine]") {
  const Mesh floor = shapes::grid({}, {10, 0, 0}, {0, 10, 0});
  const AutoRefinement refined = refine(floor, 0.001);
  CHECK(refined.end == RefineEnd::met);
  CHECK(refined.rounds == 1);
  CHECK(refined.refined.mesh.positions == floor.positions);
  CHECK(refined.refined.mesh.triangles == floor.triangles);
  CHECK(refined.after < 1e-6);
}

TEST_CASE("a closed mesh stays closed", "[auto_refine]") {
  const Mesh room = shapes::boxRoom();
  BakeOptions bake = shadowed();
  bake.kind = TransferKind::interreflected;
  // A room with a pillar, so that light changes; closed, all is black, so the target is met at once.
  Mesh scene = shapes::merged(shapes::box({0, 0, 0}, {4, 4, 3}), shapes::box({6, 1, 0}, {7, 2, 5}));
  const AutoRefinement refined = refine(scene, 0.01, bake);
  CHECK(refined.rounds > 1);
  Progress progress;
  const MeshCheck check = checkMesh(refined.refined.mesh, progress);
  CHECK(check.closed());
  CHECK(check.nonManifoldEdges.count == 0);
  CHECK(check.flippedEdges.count == 0);
  CHECK(refine(room, 0.01, bake).rounds == 1);
}

TEST_CASE("curved meshes stay as they are", "[auto_refine]") {
  const Mesh sphere = shapes::icosphere(2, 0.05);
  const AutoRefinement refined = refine(sphere, 0.001);
  CHECK(refined.end == RefineEnd::noFlat);
  CHECK(refined.refined.mesh.triangles == sphere.triangles);
  CHECK(refined.rounds == 0);
}

TEST_CASE("what curved parts miss is told apart", "[auto_refine]") {
  // A lumpy sphere of coarse faces above a floor that it darkens.
  const Mesh lump = shapes::translated(shapes::icosphere(1, 0.3), {0, 0, 1.2});
  const Mesh mesh = shapes::merged(shapes::grid({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), lump);
  const AutoRefinement refined = refine(mesh, 0.005);
  CHECK(refined.end == RefineEnd::flatDone);
  CHECK(refined.curved > 0.005);
  CHECK(refined.after >= refined.curved);
  CHECK(refined.after < 0.95 * refined.before);
}

TEST_CASE("flat parts get no vertices that would not show beside what curved parts miss", "[auto_refine]") {
  // The same sphere, much larger than the tile in its shadow.
  const Mesh lump = shapes::translated(shapes::icosphere(1, 0.3), {0, 0, 1.2});
  const Mesh mesh = shapes::merged(shapes::grid({-0.3, -0.3, 0}, {0.6, 0, 0}, {0, 0.6, 0}), lump);
  const AutoRefinement refined = refine(mesh, 0.005);
  CHECK(refined.end == RefineEnd::flatDone);
  CHECK(refined.refined.mesh.positions == mesh.positions);
  // The flat part misses more than the target all the same.
  const double flat = std::pow(refined.after, 2) - std::pow(refined.curved, 2);
  INFO("flat " << std::sqrt(flat) << " curved " << refined.curved);
  CHECK(flat > 0.005 * 0.005);
  CHECK(flat < 0.11 * std::pow(refined.curved, 2));
}

TEST_CASE("a budget of vertices is kept", "[auto_refine]") {
  const AutoRefinement refined = refine(boxOnFloor(), 0.005, shadowed(), 150);
  CHECK(refined.end == RefineEnd::budget);
  CHECK(refined.refined.mesh.positions.size() <= 150);
  CHECK(refined.after < refined.before);
}

TEST_CASE("few flat faces that are lit evenly are passed over, those in a shadow are not", "[auto_refine]") {
  // A lumpy sphere and a small tile far from it, which sees the whole sky.
  const Mesh lump = shapes::icosphere(2, 0.2);
  const Mesh tile = shapes::grid({50, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0});
  const AutoRefinement open = refine(shapes::merged(lump, tile), 0.05);
  CHECK(open.end == RefineEnd::flatFine);
  CHECK(open.rounds == 0);
  CHECK(open.refined.mesh.positions == shapes::merged(lump, tile).positions);
  // The same tile with a box on it.
  const Mesh box = shapes::box({50.2, 0.2, 0}, {50.3, 0.3, 0.4});
  CHECK(refine(shapes::merged(shapes::merged(lump, tile), box), 0.02).rounds > 1);
}

TEST_CASE("a mesh of more vertices than allowed stays as it is", "[auto_refine]") {
  const Mesh mesh = boxOnFloor();
  const AutoRefinement refined = refine(mesh, 0.05, shadowed(), mesh.positions.size() - 1);
  CHECK(refined.end == RefineEnd::budget);
  CHECK(refined.refined.mesh.positions == mesh.positions);
}

TEST_CASE("refinement does not depend on threads, and stops when asked", "[auto_refine]") {
  const Mesh mesh = boxOnFloor();
  const AutoRefinement one = refine(mesh, 0.05), other = refine(mesh, 0.05, shadowed(), 1'000'000, 3);
  CHECK(one.refined.mesh.positions == other.refined.mesh.positions);
  CHECK(one.refined.mesh.triangles == other.refined.mesh.triangles);
  CHECK(one.after == other.after);
  const Parallel parallel(2);
  AutoRefineOptions options;
  options.target = 0.05;
  Progress unwatched;
  ScenePoints points = makeScenePoints(mesh, {}, {}, {}, unwatched);
  int reports = 0;
  Progress progress([&](const ProgressState&) { return ++reports < 20; }, Progress::Duration(0));
  TracedScene scene(std::move(points), parallel, progress);
  try {
    refineWhereLightChanges(mesh, {}, scene, {}, {}, shadowed(), options, parallel, progress);
    FAIL("it was not stopped");
  } catch (const Error& e) {
    CHECK(e.kind() == ErrorKind::cancelled);
  }
}

TEST_CASE("targets out of range are refused", "[auto_refine]") {
  for (const double target : {0.0, 1e-5, 1.1, std::nan("")}) {
    CHECK_THROWS_AS(refine(boxOnFloor(), target), Error);
  }
}
