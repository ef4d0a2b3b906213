// The error between the vertices against their number: what a fit and finer flat parts bring.
#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "chart/sweep/chart_data.h"
#include "chart/sweep/deadline.h"
#include "mesh/mesh.h"

namespace shbake::chart {

struct SurfaceStudyOptions {
  int order = 4;                  ///< bands, 1..8
  int rays = 256;                 ///< of each vertex, 16..65536
  double secondsPerPointRay = 0;  ///< CPU seconds that one ray of one point is expected to take
  std::size_t samples = 2048;     ///< places of the surface where errors are measured: SurfaceErrorOptions::samples
};

/// Bakes shadowed transfer of `mesh` as it is, with its flat parts divided into edges of even length, ever halved, and
/// with them divided where the light changes, to ever smaller errors: each with the transfer of the vertices and with
/// `--fit auto`. Goes on while the next mesh is expected to fit the time; a note of `data` tells why nothing was
/// refined, or measured at all. Throws as bakePoints().
void studySurface(const Mesh& mesh, const SurfaceStudyOptions& options, const Deadline& deadline,
                  const Parallel& parallel, Progress& progress, ChartData& data);

}  // namespace shbake::chart
