// What a viewer sees: the error of the transfer that is interpolated between the vertices.
//
// Vertices may be exact and the picture wrong, since between them the transfer is interpolated. The error is measured
// at points x of the faces that had no part in the bake, against the transfer t*(x) that is traced there:
//   E^2 = 1/A integral over the surface of |t(x) - t*(x)|^2 / |t_unshadowed(x)|^2 dA,
// with t(x), the normal and the albedo at x interpolated as a renderer does. Rays give t* with noise, which would add
// its variance to E^2. Two independent sets of rays give t1 and t2, whose noise cancels in the mean of
//   (t - t1) . (t - t2) = |t - (t1 + t2)/2|^2 - |t1 - t2|^2 / 4:
// the squared error against all rays, less what the difference of the sets tells of their noise. The samples are
// stratified: two in each of equal areas along the Morton curve of the faces (sampled_mean.h).
#pragma once

#include <cstddef>

#include "bake/bake_options.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// Rays in each of the two sets of a sample: their noise cancels in the mean, but scatters it, and the worst error is
/// that of one sample.
struct TruthRays {
  /// For each ray of the bake, 1 or more: at an error of N^-3/4, both sets of four times as many have a fifth of the
  /// bake's noise.
  int perRay = 4;
  /// A set has at least this many, since the noise of few rays would hide small errors however it is subtracted.
  int least = 512;
};

struct SurfaceErrorOptions {
  /// Points to measure at, 16..1048576, rounded up to an even number. The relative error of the RMS falls as their
  /// inverse square root, from about 4 % at 1024 of a smoothly spread error.
  std::size_t samples = 1024;
  /// The first faces of the points, which are measured; those behind them only block and reflect. 0: all.
  std::size_t faces = 0;
  TruthRays rays{};

  static constexpr std::size_t kLeastSamples = 16, kMostSamples = 1 << 20;
};

/// Throws a usage error where an option is out of its range.
void validate(const SurfaceErrorOptions& options);

/// Measures the transfer that bakePoints() gave with the options `bake`, where `rays` must be the number that it took;
/// corners of measured faces must have been wanted. Each sample takes two sets of options.rays. What faces
/// reflect to a sample is what was baked for them, interpolated; where reflections were summed to a count, what is
/// baked again with one less. Faces without area or with black corners have no relative error and are left out: the
/// result has no samples where all are. Deterministic: depends on `points`, `baked` and options alone.
/// Throws a usage error for options out of range or a transfer that does not belong to the points; cancelled by
/// `progress`.
SurfaceError measureSurfaceError(TracedPoints& traced, const TransferSet& baked, const BakeOptions& bake,
                                 const SurfaceErrorOptions& options, const Parallel& parallel, Progress& progress);

/// The same for points that nobody else traces.
SurfaceError measureSurfaceError(const LightingPoints& points, const TransferSet& baked, const BakeOptions& bake,
                                 const SurfaceErrorOptions& options, const Parallel& parallel, Progress& progress);

}  // namespace shbake
