// Smoothing baked transfer by its own stated noise: what few rays scatter, neighbours share.
//
// The light that a point lacks against the open sky varies slowly over a surface, but is baked with independent noise
// at each vertex. Averaging it over the neighbours removes noise, and blurs where light really changes. What a
// neighbour would be off as an estimate for the point is seen from the difference of the two, less what their stated
// variances explain of it. Each neighbour counts by the inverse of its variance plus that bias squared: the weights of
// least mean squared error where noise and bias of the neighbours are independent.
#pragma once

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// The coefficients of `baked` with one pass of smoothing over the points that share a face: maths.md (29). `baked` has
/// stated errors, whose `error` is the standard deviation of the noise. `wanted` has an entry for each point, or none
/// where all are wanted; others are neither changed nor looked at, nor are points that are black in some channel.
/// Exact points (error 0) stay. Progress counts points.
std::vector<float> smoothedCoefficients(const LightingPoints& points, const std::vector<std::uint8_t>& wanted,
                                        const TransferSet& baked, const Parallel& parallel, Progress& progress);

}  // namespace shbake
