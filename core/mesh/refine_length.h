// The edge length that a refinement asks for, and what may be asked.
#pragma once

#include <cstdint>
#include <functional>

#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake {

/// The length of edges wanted at `place` of face `face` of a mesh, in file units: positive; infinity where the face
/// needs no division. It should change by at most half of the distance between two places. It is called from several
/// threads at once, for places on the face or, by a rounding, beside it.
using EdgeLength = std::function<double(std::uint32_t face, const Vec3d& place)>;

/// What `length` says, but no less than what coordinates can tell apart with room to spare (kLeastUlps). Throws a usage
/// error for what is not positive.
double edgeLengthAt(const Mesh& mesh, const EdgeLength& length, std::uint32_t face, const Vec3d& place);

/// Rounding moves points by up to an ulp; triangles with sides of this many stay triangles.
inline constexpr double kLeastUlps = 64;

}  // namespace shbake
