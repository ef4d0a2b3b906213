// The baseline: Green's own loop, given Embree, a table of the basis and an intersection filter.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/lighting_points.h"

namespace shbake::bench {

struct GreenBake {
  std::vector<double> transfer;  ///< points x 3 channels x order^2
  double traced = 0;             ///< rays traced a point, on average
  double cpu = 0;                ///< CPU seconds of the loop, without the BVH
};

/// Shadowed diffuse transfer as in R. Green, "Spherical Harmonic Lighting: The Gritty Details", 2003: `side` x `side`
/// jittered samples of the whole sphere, shared by all points, of which those above the tangent plane are traced one by
/// one and added in double precision to three channels of the given albedo. Runs on the calling thread over every
/// `step`-th point; `cpu` is scaled up to all points. The factor 1/pi that his code omits is put in.
GreenBake bakeLikeGreen(const LightingPoints& points, const std::vector<std::uint32_t>& chosen, int order, int side,
                        std::uint64_t seed);

}  // namespace shbake::bench
