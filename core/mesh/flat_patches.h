// Patches: parts of flat regions in which triangles can be cut anew without changing anything else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/flat_edges.h"
#include "mesh/flat_regions.h"
#include "mesh/mesh.h"
#include "mesh/refine_attributes.h"

namespace shbake {

/// Sets of faces that hang together, lie in one plane to the rounding of their coordinates, and carry attributes that
/// are one affine function over all of them.
struct FlatPatches {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  struct Range {
    std::uint32_t begin, end;
  };

  std::vector<std::uint32_t> faces;   ///< of the patches, one after the other
  std::vector<Range> ranges;          ///< of each patch in `faces`
  std::vector<std::uint32_t> ofFace;  ///< F patch numbers; kNone: in no flat region

  std::size_t size() const { return ranges.size(); }
  /// The faces of a patch: the first and largest one's plane is that of the patch.
  std::span<const std::uint32_t> operator[](std::size_t patch) const {
    return {faces.data() + ranges[patch].begin, faces.data() + ranges[patch].end};
  }
};

/// Divides the flat regions of a mesh into patches, which grow from the largest face on. In a patch a position stands
/// for one vertex, and neighbouring faces share the vertices of their edge: seams of texture coordinates and the like
/// lie between patches. Progress counts faces.
FlatPatches findFlatPatches(const Mesh& mesh, const EdgeTable& edges, const FlatRegions& regions, Progress& progress);

/// Whether a side of a face in a patch bounds it: edges inside a patch may be replaced, those on its border may not.
bool isPatchBorder(const EdgeTable& edges, const FlatPatches& patches, const AttributeContinuity& attributes,
                   FaceSide side);

/// Makes each face of a patch one of its own: the first keeps the number, the others get new ones at the end.
void separateFaces(FlatPatches& patches, std::uint32_t patch);

}  // namespace shbake
