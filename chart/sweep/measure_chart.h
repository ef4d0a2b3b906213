// The whole measurement behind a chart, in one function.
#pragma once

#include <string>

#include "base/parallel.h"
#include "base/progress.h"
#include "chart/sweep/chart_data.h"
#include "chart/sweep/sweep.h"
#include "light/light.h"
#include "mesh/lighting_points.h"
#include "mesh/mesh.h"

namespace shbake::chart {

struct MeasureOptions {
  std::string mesh;  ///< its name, for titles
  SweepOptions sweep;
  double budget = 120;            ///< seconds by the wall clock, 1..100000
  std::size_t sample = 2048;      ///< points that are measured at most, 16 or more
  int referenceRays = 32768;      ///< of each of the two reference estimates, 256..1048576
  std::string cache;              ///< keeps the reference; empty: nothing does
  std::string surfaceCache;       ///< the same of places between the vertices
  const Mesh* surface = nullptr;  ///< the mesh of the points, for the error between its vertices; null: not measured
  const Light* light = nullptr;   ///< under which orders are judged too; null: none
  std::string lightName;
};

/// Reference, sweep over methods and rays, orders, reflections, the error between vertices and advice, within the
/// budget but for the BVH, one block of reference points and the smallest setting of each method, which are measured in
/// any case. What the time did not allow is told in the notes. Throws a usage error for options out of range, cancelled
/// by `progress`.
ChartData measureChart(const LightingPoints& points, const MeasureOptions& options, const Parallel& parallel,
                       Progress& progress);

}  // namespace shbake::chart
