// The tracing limit: Embree answering the rays of a bake, and nothing else.
#pragma once

#include <cstdint>

#include "bake/direction_set.h"
#include "mesh/lighting_points.h"

namespace shbake::bench {

/// CPU seconds that Embree alone takes to answer the rays of all points: the same directions in the same order and the
/// same form (packets of 16 where native, else streams) as the bake's. Preparing rays is not counted. `filtered` leaves
/// out the faces that touch the point, as a bake must.
double rawTracing(const LightingPoints& points, const DirectionSet& directions, std::uint64_t seed, bool filtered);

}  // namespace shbake::bench
