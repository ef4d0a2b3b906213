// The lighting points of a mesh and its blockers.
#pragma once

#include <vector>

#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "mesh/mesh.h"
#include "pipeline/albedo.h"

namespace shbake {

/// Lighting points of everything that takes part in the transport of light. The mesh's vertices and faces come first in
/// their order, those of blockers behind them.
struct ScenePoints {
  LightingPoints points;
  ResolvedAlbedo albedo;  ///< of the mesh, not of its blockers
};

/// Throws as resolveAlbedo() and makeLightingPoints().
ScenePoints makeScenePoints(const Mesh& mesh, const std::vector<Mesh>& blockers, const LightingPointOptions& points,
                            const AlbedoOptions& albedo, Progress& progress);

}  // namespace shbake
