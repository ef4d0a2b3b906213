// The lighting points of a mesh and its blockers, with what their rays are traced in.
#pragma once

#include <utility>

#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "pipeline/scene_points.h"

namespace shbake {

/// What a glance, a probe, the bake and its judge look at one after another, in one place: a large mesh has it in
/// memory once.
struct TracedScene {
  LightingPoints points;
  ResolvedAlbedo albedo;  ///< of the mesh, not of its blockers
  TracedPoints traced;    ///< refers to `points`

  TracedScene(ScenePoints made, const Parallel& parallel, Progress& progress)
      : points(std::move(made.points)), albedo(std::move(made.albedo)), traced(points, parallel, progress) {}
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;
};

}  // namespace shbake
