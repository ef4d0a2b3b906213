// Refinement of meshes with defects, of scenes and of scans: nothing is lost.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <set>

#include "mesh/mesh_reader.h"
#include "mesh/refine.h"
#include "refine_checks.h"
#include "support/shapes.h"

using namespace shbake;

TEST_CASE("defects of meshes survive", "[refine]") {
  for (const Mesh& mesh : shapes::defects()) {
    for (const double length : {0.05, 0.4}) {
      INFO(mesh.source << " at " << length);
      checkKept(mesh, refinedTo(mesh, length));
    }
  }
}

TEST_CASE("needles a million times as long as wide survive", "[refine]") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}, {0.5, 0.7, 0}, {0.5, -0.7, 0}};
  // Two needles on each other, and a triangle on either side of them.
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {1, 0, 4}};
  mesh = inFloats(mesh);
  for (const double length : {0.3, 0.03}) {
    for (const Vec3d& shift : {Vec3d(0, 0, 0), Vec3d(0.3, 0.1, 0.7)}) {
      const Mesh moved = inFloats(shapes::translated(mesh, shift));
      const RefinedMesh refined = refinedTo(moved, length);
      checkKept(moved, refined);
      CHECK(refined.mesh.positions.size() > moved.positions.size());
    }
  }
}

TEST_CASE("a region that overlaps itself is refined face by face", "[refine]") {
  // A fan that turns by 12 x 43 degrees around its tip, in one plane: its last faces lie on its first ones.
  Mesh mesh;
  mesh.positions.push_back({0, 0, 0});
  for (int i = 0; i <= 12; ++i) {
    const double angle = i * 43 * std::numbers::pi / 180;
    mesh.positions.push_back({std::cos(angle) * (1 + 0.01 * i), std::sin(angle) * (1 + 0.01 * i), 0});
  }
  for (std::uint32_t i = 1; i <= 12; ++i) mesh.triangles.push_back({0, i, i + 1});
  mesh = inFloats(mesh);
  const RefinedMesh refined = refinedTo(mesh, 0.1);
  checkKept(mesh, refined);
  CHECK(areaOf(refined.mesh) == Approx(areaOf(mesh)).epsilon(1e-6));
  CHECK(refined.report.left.empty());
  std::set<std::uint32_t> sources;
  for (std::size_t f = 0; f < refined.mesh.triangles.size(); ++f) {
    if (refined.mesh.triangles[f] != mesh.triangles[refined.sourceFace[f]]) sources.insert(refined.sourceFace[f]);
  }
  CHECK(sources.size() == 12);
}

TEST_CASE("faces too thin for new vertices are left, named, and agree with their neighbours", "[refine]") {
  // A needle a million times as long as wide between two triangles: near its tip, points on its long sides are nearer
  // to each other than rounding moves them. Colours keep the three from being one patch.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1.5e-6, 0}, {1, -1.5e-6, 0}, {0.5, 0.7, 0}, {0.5, -0.7, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {2, 0, 4}};
  mesh.faceColors = {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1)};
  mesh = shapes::rotated(mesh, shapes::rotationAbout({0.3, -0.5, 0.8}, 0.9));
  mesh = inFloats(shapes::translated(mesh, {1, 1, 1}));
  const RefinedMesh refined = refinedBy(mesh, [](std::uint32_t face, const Vec3d&) { return face == 0 ? 2e-4 : 0.05; });
  checkKept(mesh, refined);
  REQUIRE(refined.report.left.size() == 1);
  CHECK(refined.report.left[0].firstFace == 0);
  CHECK(refined.report.left[0].faces == 1);
  CHECK_FALSE(refined.report.left[0].reason.empty());
  // Its neighbours are refined all the same, and only as they want it.
  CHECK(refined.mesh.positions.size() > 150);
  CHECK(refined.mesh.positions.size() < 1000);
}

TEST_CASE("both sides of a doubled sheet are cut alike", "[refine]") {
  const Mesh front =
      shapes::rotated(shapes::grid({0, 0, 0}, {1, 0, 0}, {0.2, 0.8, 0}, 2, 1), shapes::rotationAbout({1, 2, 3}, 1));
  const Mesh mesh = inFloats(shapes::merged(front, shapes::shuffled(shapes::flipped(front), 5).mesh));
  const auto graded = [&](std::uint32_t, const Vec3d& p) { return 0.02 + 0.3 * length(p - mesh.positions[0]); };
  const RefinedMesh refined = refinedBy(mesh, graded);
  checkKept(mesh, refined);
  CHECK(refined.mesh.positions.size() > 6 * mesh.positions.size());
}

TEST_CASE("scenes and scans keep what they are", "[refine]") {
  for (const Mesh& mesh : {shapes::city(3, 1, 1), shapes::tiltedBoxesOnGround(), shapes::boxRoom(2),
                           shapes::columns(2, 12), shapes::tJunctionFloor(3), shapes::redFloorWhiteWall(3)}) {
    INFO(mesh.source);
    const Mesh stored = inFloats(mesh);
    const RefinedMesh refined = refinedTo(stored, 0.1);
    checkKept(stored, refined);
    CHECK(refined.report.refined > 0);
    CHECK(areaOf(refined.mesh) == Approx(areaOf(stored)).epsilon(1e-6));
  }
}

TEST_CASE("real meshes keep what they are", "[refine]") {
  const std::filesystem::path folder = std::filesystem::path(SHBAKE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: no folder " << folder);
    return;
  }
  Progress progress;
  const auto read = [&](const char* name) { return readMesh((folder / name).string(), progress); };
  const Mesh fandisk = read("fandisk.obj");
  const RefinedMesh refined = refinedTo(fandisk, 0.1);
  checkKept(fandisk, refined);
  CHECK(refined.report.flatArea > 0.4 * refined.report.area[0]);
  const Mesh suzanne = read("suzanne.obj");
  checkKept(suzanne, refinedTo(suzanne, 0.02));
  for (const char* name : {"spot.obj", "teapot.obj", "igl_halftunnel.off"}) {
    const Mesh curved = read(name);
    CHECK(sameMesh(refinedTo(curved, 1e-4).mesh, curved));
  }
  const Mesh bunny = read("stanford-bunny.obj");
  CHECK(sameMesh(refinedTo(bunny, 0.005).mesh, bunny));
}
