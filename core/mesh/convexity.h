// Whether a mesh is one convex solid, whose surface sees nothing but the sky.
#pragma once

#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// True when the faces bound one convex solid and face outwards: each edge has two faces that are wound alike and do
/// not bend inwards by more than the rounding of coordinates explains, and the solid fills its convex hull but for a
/// millionth of the volume; and where no lighting point's normal leans so far that its own faces rise above the plane
/// that it is the normal of. Faces without area count for nothing but their edges. Progress counts faces.
bool isConvexSolid(const LightingPoints& points, Progress& progress);

}  // namespace shbake
