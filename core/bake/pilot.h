// How many rays a tolerance needs.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/bake_options.h"
#include "bake/ray_scene.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Some hundred of the wanted points (all where `wanted` is empty), spread over the mesh, in ascending order: one at
/// random from each of equal stretches of the Morton curve, or all where there are no more.
std::vector<std::uint32_t> pilotPoints(const LightingPoints& points, const std::vector<std::uint8_t>& wanted);

/// The number of directions a point, a multiple of 16 up to 1048576, at which the stated RMS error of the wanted points
/// (all where `wanted` is empty) meets options.tolerance, judged by tracing some hundred points spread over the mesh.
int chooseRays(const LightingPoints& points, const std::vector<std::uint8_t>& wanted, const RayScene& scene,
               const BakeOptions& options, const Parallel& parallel, Progress& progress);

}  // namespace shbake
