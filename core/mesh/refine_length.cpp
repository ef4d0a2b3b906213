// The edge length that a refinement asks for.
#include "mesh/refine_length.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "mesh/flat_geometry.h"

namespace shbake {

double edgeLengthAt(const Mesh& mesh, const EdgeLength& length, std::uint32_t face, const Vec3d& place) {
  const double wanted = length(face, place);
  if (!(wanted > 0)) {
    throw usageError("an edge length of " + std::to_string(wanted) + " is asked for at face " + std::to_string(face),
                     "lengths are positive");
  }
  return std::max(wanted, kLeastUlps * FaceShape(mesh, face).ulp);
}

}  // namespace shbake
