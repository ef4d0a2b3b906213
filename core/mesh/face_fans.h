// Faces that meet at a position, clustered into fans that a half-edge structure can hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/passes.h"
#include "base/vec3.h"
#include "mesh/mesh.h"
#include "mesh/packed_lists.h"

namespace shbake {

/// Corner k of face f has the number 3f + k, which is also that of the half-edge from it to the face's next corner.
constexpr std::uint32_t nextCorner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
constexpr std::uint32_t previousCorner(std::uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// The position id at a corner.
inline std::uint32_t positionAt(const std::vector<Triangle>& faces, std::uint32_t corner) {
  return faces[corner / 3][corner % 3];
}

/// Whether two corners of a face are at the same position.
constexpr bool isDegenerate(const Triangle& face) {
  return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// The corners at each position (of degenerate faces too) in ascending order. Requires position ids < `positions`.
/// Four passes.
PackedLists cornersAtPositions(const std::vector<Triangle>& faces, std::size_t positions, Passes& passes);

/// The unit normal of a face; zero when it has no extent. The same bits whichever corner the face begins with.
Vec3d faceNormal(const std::vector<Vec3f>& positions, const Triangle& face);

/// The half-edge on the other side of each half-edge; kNoCorner at a boundary, between faces wound against each other,
/// and in degenerate faces. Where more than two faces share an edge, a surface goes on from one face to another that is
/// wound alike when each is the other's smoothest continuation, without a tie; the rest is cut. `positions` are in work
/// units. One pass.
std::vector<std::uint32_t> oppositeHalfEdges(const std::vector<Vec3f>& positions, const std::vector<Triangle>& faces,
                                             const PackedLists& corners, Passes& passes);

inline constexpr std::uint32_t kNoCorner = 0xFFFFFFFFu;

/// Corners clustered into fans: corners at one position whose faces follow each other across pairs of opposite
/// half-edges. The faces of a fan form a disc or a half-disc around its position, whatever else touches the position.
struct FaceFans {
  std::vector<std::uint32_t> ofCorner;  ///< 3F fan numbers; kNoCorner in degenerate faces
  std::vector<std::uint32_t> position;  ///< the position of each fan
};

/// Clusters the corners of all faces by their opposite half-edges. One pass.
FaceFans faceFans(const std::vector<Triangle>& faces, const std::vector<std::uint32_t>& opposite, Passes& passes);

}  // namespace shbake
