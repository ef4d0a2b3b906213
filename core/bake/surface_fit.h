// Vertex values for what lies between the vertices (Kavan, Bargteil, Sloan, "Least Squares Vertex Baking", Computer
// Graphics Forum 30(4), EGSR 2011).
//
// A vertex of a coarse mesh that has the true transfer of its own place may still give wrong pictures: at the foot of a
// wall it is as dark as the corner, and interpolation carries that darkness across the whole face. A fit gives each
// lighting point the value with which the interpolated transfer is nearest to the true one over the surface, by rays
// from places between the vertices. How much of it is taken is decided by measurement: samples that the fit has not
// seen tell, region by region, whether it helps there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bake/baker.h"
#include "bake/sampled_mean.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// What baked values of vertices are for.
enum class FitKind {
  automatic,  ///< fitted to the surface, or smoothed, where samples show that it helps
  vertex,     ///< the transfer at the vertex itself
  surface,    ///< fitted to the surface everywhere
};

/// The name used on the command line and in reports: "auto", "vertex", "surface".
const char* fitName(FitKind kind);

struct SurfaceFitOptions {
  FitKind kind = FitKind::vertex;
  /// Places on the surface for each lighting point, 1..64, to which the values are fitted.
  int samplesPerPoint = 4;
  /// Rays from each of these places, 16..65536; 0: a quarter of the bake's, 32 to 256, so that a fit at the default
  /// number of places takes about the time of the bake.
  int raysPerSample = 0;
  /// Relative RMS, 0 or more: where the pilot is sure that points err no more than that between them, an automatic fit
  /// leaves them as they are.
  double enough = 0;
};

/// Throws a usage error that names the first option out of its range.
void validate(const SurfaceFitOptions& options);

/// What came of a fit.
struct FitReport {
  std::string reason;              ///< why values were changed, or not; one sentence without a full stop
  std::size_t fittedPoints = 0;    ///< lighting points that took some of the fit
  std::size_t smoothedPoints = 0;  ///< lighting points that took some of the smoothing
  std::size_t regions = 0;         ///< parts of the surface that were judged by themselves
  std::size_t fittedRegions = 0;   ///< those among them that took some of the fit
  std::size_t samples = 0;         ///< places that were fitted to
  std::size_t heldOut = 0;         ///< places that judged
  double rays = 0;                 ///< traced for both, and for what looked whether to fit
  double fittedRays = 0;           ///< those among them that values were fitted to
  double ridge = 0;                ///< how many times the mass of its samples a point's own value weighed
  /// The error as SurfaceError has it, free of the noise of the rays, at samples of the surface that had no part in
  /// the fit; 0 where there were no samples.
  RmsError before, after;
};

/// Replaces baked transfer by what is best interpolated. `baked` is what bakePoints() gave for the same points, wanted
/// points and options; only its coefficients change, and those of points that are not wanted do not. Its stated errors
/// and visibility stay those of the points as they were traced: a fitted value is off from the transfer at the vertex
/// on purpose, and `after` says how well it does.
///   vertex: nothing is done. automatic: a pilot, on small meshes first a glance or two, measures what interpolation
///   misses; where the pilot is sure that this is good enough, it stops. Values are smoothed (smoothing.h), and where
///   interpolation errs too little beside the noise of the rays (fit_prospect.h) that is all; else values are fitted,
///   and each region takes as much of the fit as samples that had no part in it show to help.
///   surface: values are fitted everywhere, unasked.
/// Unshadowed transfer stays as it is. Deterministic: depends on points, options and seed only. Memory: about 16 bytes
/// for each coefficient of the result, 600 a point, and for each sample in a batch of at most a million 150 and one row
/// of the result, beside the ray scene; `bake.memory` changes nothing. Throws as bakePoints(), and leaves `baked` as it
/// was then.
FitReport fitToSurface(TracedPoints& traced, const std::vector<std::uint8_t>& wanted, PointBake& baked,
                       const BakeOptions& bake, const SurfaceFitOptions& options, const Parallel& parallel,
                       Progress& progress);

/// The same for points that nobody else traces.
FitReport fitToSurface(const LightingPoints& points, const std::vector<std::uint8_t>& wanted, PointBake& baked,
                       const BakeOptions& bake, const SurfaceFitOptions& options, const Parallel& parallel,
                       Progress& progress);

}  // namespace shbake
