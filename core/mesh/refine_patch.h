// One flat patch, cut anew: its border as the edges are divided, its inside as densely as asked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesh/contact_lines.h"
#include "mesh/flat_edges.h"
#include "mesh/flat_patches.h"
#include "mesh/mesh.h"
#include "mesh/patch_mesher.h"
#include "mesh/refine_attributes.h"
#include "mesh/refine_edges.h"
#include "mesh/refine_length.h"

namespace shbake {

/// The new faces of a patch. Their points are numbered 0, 1, ... : first `vertices`, then `edgePoints`, then the inner
/// points.
struct PatchMesh {
  struct EdgePoint {
    std::uint32_t side;   ///< of a face of the patch, on which it lies
    std::uint32_t index;  ///< in the divisions of the edge
  };

  std::vector<std::uint32_t> vertices;  ///< of the mesh
  std::vector<EdgePoint> edgePoints;
  std::vector<Blend> innerBlends;
  std::vector<Vec3d> innerPositions;
  std::vector<Triangle> faces;
  std::vector<std::uint32_t> sourceFace;  ///< the face of the mesh behind each new one
};

/// What a patch is made from. All but the counters are borrowed.
struct PatchSource {
  const Mesh& mesh;
  const EdgeTable& edges;
  const FlatPatches& patches;
  const AttributeContinuity& attributes;
  const EdgeDivisions& divisions;
  const EdgeLength& length;
  const ContactLines& contacts;
  double rowOffset;        ///< what rows of points at these keep from them, in file units
  PointCounter countNew;   ///< told of new inner points
  PointCounter countDone;  ///< told of points that have been gone through
};

/// Cuts a patch anew. Nothing where that cannot be done without changing its shape: its faces overlap, or are so thin
/// that rounding the new points to the precision of the file turns some over. A patch in which nothing is to be divided
/// gets no faces. The file's vertices, edges between patches as they have been divided, and the plane are kept; new
/// points lie on the faces that they are blended from to kPlaneUlps. `rowsAlone`: only rows along contact lines are
/// added.
std::optional<PatchMesh> meshPatch(const PatchSource& source, std::uint32_t patch, bool rowsAlone);

}  // namespace shbake
