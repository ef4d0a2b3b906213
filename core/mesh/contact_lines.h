// The lines along which other faces meet flat patches: a box stands on the ground, a post goes through it. Light on the
// patch changes there from one value to another, which no vertex at either side of the line can tell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/flat_edges.h"
#include "mesh/flat_patches.h"
#include "mesh/mesh.h"

namespace shbake {

/// A row of places, each joined to the next, and the last to the first where it is closed (which is not repeated).
struct Polyline {
  std::vector<Vec3d> places;  ///< at least two
  bool closed = false;
};

/// Lines on the patches of a mesh, in file units.
struct ContactLines {
  std::vector<Polyline> lines;        ///< of the patches, one after the other
  std::vector<std::uint32_t> starts;  ///< P + 1, of each patch in `lines`

  std::span<const Polyline> operator[](std::size_t patch) const {
    if (patch + 1 >= starts.size()) return {};  // of faces that were one patch with others
    return {lines.data() + starts[patch], lines.data() + starts[patch + 1]};
  }
};

/// Where faces cross a patch or stand on it, and the borders of such as lie on it with no other face along them. Only
/// faces that are no part of the patch and share no edge with the face that they meet count. The lines lie on the patch
/// to kPlaneUlps, and turn at each edge of the faces that make them. Progress counts faces.
ContactLines findContactLines(const Mesh& mesh, const EdgeTable& edges, const FlatPatches& patches, Progress& progress);

}  // namespace shbake
