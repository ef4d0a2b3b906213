// The long steps between a mesh and its lighting points can be stopped, soon, wherever they are.
#include <catch2/catch.hpp>

#include "base/passes.h"
#include "mesh/lighting_points.h"
#include "mesh/mesh_check.h"
#include "support/shapes.h"
#include "support/stopping.h"

using namespace shbake;

namespace {

/// What a pass over the corners counts between two reports, in faces of a stage with `passes` passes, and rounding.
double perReport(int passes) {
  return 1.0 * kProgressBlock / passes + 1e-6;
}

/// 81920 faces on 40962 positions: several blocks, whatever a pass goes over.
Mesh sphere() {
  return shapes::icosphere(6);
}

}  // namespace

TEST_CASE("lighting points can be stopped in every step", "[stopping]") {
  const Mesh mesh = sphere();
  // An albedo for each vertex: a pass over a single one would count as much.
  const Albedo albedo{Albedo::Per::vertex, std::vector<Rgb>(mesh.positions.size(), Rgb(1, 1, 1))};
  const auto smooth = [&](Progress& progress) {
    makeLightingPoints(mesh, {.normals = NormalSource::smooth}, albedo, progress);
  };
  // A block of positions is a larger share of all positions than a block of faces is of all faces: twice, on a sphere.
  checkStopping(smooth,
                {{"welding", 2 * perReport(7)}, {"normals", 2 * perReport(14)}, {"lighting points", 2 * perReport(9)}});

  Mesh given = mesh;
  for (const Vec3d& p : given.positions) given.vertexNormals.push_back(Vec3f(p));
  const auto asGiven = [&](Progress& progress) { makeLightingPoints(given, {}, albedo, progress); };
  checkStopping(asGiven,
                {{"welding", 2 * perReport(7)}, {"normals", perReport(1)}, {"lighting points", 2 * perReport(9)}});
}

TEST_CASE("the check of a mesh can be stopped in every step", "[stopping]") {
  const Mesh mesh = sphere();
  // Without normals to check, their two passes are not made: what they would have counted comes with the last report.
  checkStopping([&](Progress& progress) { checkMesh(mesh, progress); },
                {{"checking", 2.0 * static_cast<double>(mesh.triangles.size()) / 18 + perReport(18)}});
  Mesh given = mesh;
  for (const Vec3d& p : given.positions) given.vertexNormals.push_back(Vec3f(p));
  checkStopping([&](Progress& progress) { checkMesh(given, progress); }, {{"checking", 2 * perReport(18)}});
}
