// Smooth normals: angle-weighted over the faces that hang together at a position without a crease between them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake {

/// One normal for each sector: the faces of a fan between two creases (face_fans.h says what a fan is).
struct SmoothNormals {
  std::vector<Vec3f> normals;           ///< a unit normal for each sector
  std::vector<std::uint32_t> ofCorner;  ///< 3F sector numbers (3f + k: corner k of face f); kNone: no normal

  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
};

/// Cuts each fan at the edges where the normals of two neighbouring faces differ by more than `creaseRadians` (0..pi)
/// and gives each sector the sum of its faces' normals weighted by their angle at the position, at unit length
/// (Thuermer, Wuethrich, "Computing vertex normals from polygonal facets", J. Graphics Tools 3(1), 1998).
/// - A closed fan with a single crease is one sector: nothing separates the crease's two sides.
/// - A face so flat that the rounding of its corners decides its normal neither makes a crease nor weighs in.
/// - Normals that cancel: the sector takes its first face's. Only such flat faces: the sum of their cross products.
/// - Corners of degenerate faces, and of sectors without any extent, get kNone.
/// `positions` are in work units, `faces` triples of position ids. Throws a work error when the half-edge structure
/// does not hold every corner. Progress counts faces.
SmoothNormals smoothNormals(const std::vector<Vec3f>& positions, const std::vector<Triangle>& faces,
                            double creaseRadians, Progress& progress);

}  // namespace shbake
