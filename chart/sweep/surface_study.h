// What a viewer sees against time: the error between the vertices by rays, by fits and by refinement.
#pragma once

#include <string>

#include "base/parallel.h"
#include "base/progress.h"
#include "chart/sweep/chart_data.h"
#include "chart/sweep/deadline.h"
#include "mesh/mesh.h"

namespace shbake::chart {

struct SurfaceStudyOptions {
  int order = 4;                  ///< bands, 1..8
  int rays = 256;                 ///< of each vertex by default, 16..65536
  double secondsPerPointRay = 0;  ///< CPU seconds that one ray of one point is expected to take
  std::size_t places = 2048;      ///< of the surface, where errors are measured: SurfaceJudgeOptions::places
  std::string cache;              ///< keeps what their transfer really is; empty: nothing does
};

/// Bakes shadowed transfer of `mesh`
///   - as it is with 16 to 4096 rays a vertex, and with each of them as --fit auto and --fit surface do,
///   - with its flat parts divided into edges of even length, ever halved, and divided where the light changes, to ever
///     smaller errors, each with the transfer of the vertices and with --fit auto, and
///   - to ever smaller tolerances, as --tolerance does, which chooses vertices, rays and fit by itself,
/// and judges all at the same places of the surface. The cheapest of each come first; what the time does not allow is
/// left out, and begun work is stopped where the deadline comes. Notes of `data` tell what was left out and why. Throws
/// as bakePoints().
void studySurface(const Mesh& mesh, const SurfaceStudyOptions& options, const Deadline& deadline,
                  const Parallel& parallel, Progress& progress, ChartData& data);

}  // namespace shbake::chart
