// A plane for a mesh to stand on and to cast its shadow on.
#pragma once

#include <span>

#include "base/vec3.h"
#include "light/environment_map.h"
#include "mesh/mesh.h"

namespace shbake {

/// A horizontal square around the points, facing up, with vertexNormals: finely divided below them and half as far
/// around as they are high, coarser from there on, out to kGroundReach of their diagonal, where it passes for a
/// horizon. It lies kGroundGap of the diagonal below the lowest point, so that faces which lie flat on the ground are
/// seen and not the plane. Throws a usage error unless there are points, all finite, of which two differ.
Mesh groundPlane(std::span<const Vec3d> points, UpAxis up);

inline constexpr double kGroundReach = 40;
inline constexpr double kGroundGap = 5e-4;

}  // namespace shbake
