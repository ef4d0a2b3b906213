// Where interpolation between the vertices errs, whatever the noise of a bake.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/bake_options.h"
#include "bake/surface_places.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace shbake {

/// The square of the relative error of interpolation at each place: two estimates of its corners, by
/// options.rays directions each, and two sets of as many rays from the places, all independent, whose noise cancels in
/// the mean (relativeSquare(), surface_tracer.h). So few rays are enough, but a single value has noise of either sign.
/// Points that no place has as a corner are baked only where light is reflected between faces. Places must not be on
/// black faces; options.rays must be set, and options.kind be traced. Throws as bakePoints().
std::vector<double> interpolationSquares(TracedPoints& traced, std::span<const SurfacePlace> places,
                                         const BakeOptions& options, const Parallel& parallel, Progress& progress);

}  // namespace shbake
