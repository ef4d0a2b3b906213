// Welding by record: vertices at one position share an id, and nothing is moved or dropped.
#pragma once

#include <cstdint>
#include <vector>

#include "base/passes.h"
#include "base/vec3.h"
#include "mesh/mesh.h"
#include "mesh/work_frame.h"

namespace shbake {

/// The distinct positions of a mesh.
struct Weld {
  std::vector<Vec3f> positions;         ///< P positions in work units, along a Morton curve of 21 bits an axis; room
                                        ///< for one more
  std::vector<std::uint32_t> ofVertex;  ///< V position ids; kUnused for a vertex that no face uses

  static constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
};

/// Welds the vertices whose work positions agree bit for bit. Ids depend on the positions alone, not on their order in
/// the mesh. Requires indices < V and finite positions. Three passes.
Weld weldPositions(const Mesh& mesh, const WorkFrame& frame, Passes& passes);

}  // namespace shbake
