// Lighting points of a mesh with its blockers: the same as of the mesh alone, followed by theirs; errors that stay
// errors.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "pipeline/scene_points.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

ScenePoints pointsOf(const Mesh& mesh, const std::vector<Mesh>& blockers, const AlbedoOptions& albedo = {}) {
  Progress progress;
  return makeScenePoints(mesh, blockers, {}, albedo, progress);
}

}  // namespace

TEST_CASE("colours that are asked for and missing are an Error", "[scene_points]") {
  for (const AlbedoSource source : {AlbedoSource::vertex, AlbedoSource::face}) {
    AlbedoOptions albedo;
    albedo.source = source;
    CHECK_THROWS_AS(pointsOf(shapes::cube(), {}, albedo), Error);
    CHECK_THROWS_AS(pointsOf(shapes::cube(), {shapes::tetrahedron()}, albedo), Error);
  }
}

TEST_CASE("the mesh's faces come first, and blockers have colours of their own", "[scene_points]") {
  AlbedoOptions albedo;
  albedo.source = AlbedoSource::uniform;
  albedo.uniform = {0.5f, 0.5f, 0.5f};
  const Mesh cube = shapes::cube();
  const ScenePoints alone = pointsOf(cube, {}, albedo);
  const Mesh red = shapes::colored(shapes::translated(shapes::tetrahedron(), {9, 0, 0}), {1, 0, 0});
  const ScenePoints both = pointsOf(cube, {red}, albedo);
  REQUIRE(both.points.faces.size() == cube.triangles.size() + red.triangles.size());
  CHECK(both.albedo.note == alone.albedo.note);
  for (std::size_t f = 0; f < both.points.faces.size(); ++f) {
    const Rgb expected = f < cube.triangles.size() ? albedo.uniform : Rgb(1, 0, 0);
    for (const std::uint32_t p : both.points.facePoints[f]) CHECK(both.points.pointAlbedo[p] == expected);
  }
}
