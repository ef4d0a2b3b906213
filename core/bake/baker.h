// Baking the lighting points of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/bake_options.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// The transfer of every lighting point, and how it came about.
struct PointBake {
  TransferSet transfer;            ///< a transfer vector for each lighting point
  int rays = 0;                    ///< directions a point; 0: closed form
  int bounces = 0;                 ///< reflections summed, or steps of the solver where `converged` was asked for
  bool converged = true;           ///< false: the reflections did not reach the tolerance within the solver's steps
  double rmsError = 0;             ///< area-weighted RMS of the stated errors of the wanted points
  double maxError = 0;             ///< the largest of them
  std::size_t storedBytes = 0;     ///< hits held in memory
  std::size_t retracedPoints = 0;  ///< points traced again for each reflection because the memory budget was short
  std::size_t wantedMemory = 0;    ///< the least budget with which none would have been
};

/// Bakes all points; the stated error figures count those with wanted[p] != 0 only, and points that are not wanted may
/// be left at zero where nothing depends on them. `wanted` has an entry for each point, or none where all are wanted.
/// Memory: some 140 bytes a triangle for the BVH and what is found out about the mesh, beside the result, the stored
/// hits and the solver's vectors, which options.memory limits together; the BVH is freed after tracing unless points
/// have to be traced again (bench_memory measures it), or it is kept for more and the budget holds it too. Throws as
/// bakeMesh().
PointBake bakePoints(TracedPoints& points, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
                     const Parallel& parallel, Progress& progress);

/// The same for points that nobody else traces.
PointBake bakePoints(const LightingPoints& points, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
                     const Parallel& parallel, Progress& progress);

}  // namespace shbake
