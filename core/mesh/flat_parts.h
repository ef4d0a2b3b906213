// All that is known of the flat parts of a mesh before they are refined.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/contact_lines.h"
#include "mesh/flat_edges.h"
#include "mesh/flat_patches.h"
#include "mesh/flat_regions.h"
#include "mesh/mesh.h"

namespace shbake {

struct FlatParts {
  EdgeTable edges;  ///< of the whole mesh
  FlatRegions regions;
  // What addPatches() finds:
  FlatPatches patches;
  ContactLines contacts;  ///< of the patches
  double rowOffset = 0;   ///< what rows of vertices along these keep from them, in file units

  /// Whether other faces meet a region.
  std::vector<bool> regionsInContact() const;
};

/// Finds edges and regions. Throws an Error for indices or positions that are not valid, and what findFlatRegions()
/// throws.
FlatParts findFlatParts(const Mesh& mesh, const FlatOptions& options, Progress& progress);

/// Finds all else, of the same mesh.
void addPatches(FlatParts& parts, const Mesh& mesh, Progress& progress);

}  // namespace shbake
