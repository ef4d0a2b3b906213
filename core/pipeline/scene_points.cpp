#include "pipeline/scene_points.h"

#include "pipeline/scene.h"

namespace shbake {

ScenePoints makeScenePoints(const Mesh& mesh, const std::vector<Mesh>& blockers, const LightingPointOptions& points,
                            const AlbedoOptions& albedo, Progress& progress) {
  // Not as an initialiser: where it throws, GCC 12 destroys the members before it twice.
  ScenePoints result;
  result.albedo = resolveAlbedo(mesh, albedo);
  if (blockers.empty()) {
    result.points = makeLightingPoints(mesh, points, result.albedo.albedo, progress);
    return result;
  }
  // Blockers have colours of their own or none.
  AlbedoOptions blockerOptions = albedo;
  blockerOptions.source = AlbedoSource::automatic;
  std::vector<Albedo> albedos;
  for (const Mesh& b : blockers) albedos.push_back(resolveAlbedo(b, blockerOptions).albedo);
  const Scene scene = joinScene(mesh, result.albedo.albedo, blockers, albedos);
  result.points = makeLightingPoints(scene.mesh, points, scene.albedo, progress);
  return result;
}

}  // namespace shbake
