// Which faces of a mesh lie in flat regions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "mesh/flat_edges.h"
#include "mesh/mesh.h"

namespace shbake {

struct FlatOptions {
  /// Degrees, 0..45: a face belongs to a flat region when its normal is within this of the region's. One degree is more
  /// than the rounding of coordinates turns the faces of a plane by, and less than what lies between the faces of a
  /// curve: a circle in 180 sectors has two.
  double flatDegrees = 1;
  /// Degrees, 0..180: faces that meet at a smaller angle share their normals (LightingPointOptions::creaseDegrees).
  double creaseDegrees = 50;
};

/// Sets of faces that hang together and lie in one plane, but for a small angle.
struct FlatRegions {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::vector<std::uint32_t> ofFace;  ///< F region numbers in the order of their first faces; kNone: curved
  std::size_t count = 0;
};

/// Regions grow from the largest face on, across edges of two faces that are wound alike, to all faces within
/// `flatDegrees` of the first one's plane. A region is taken for part of a curved surface, and left out, where that
/// goes on beyond it with a bend that shading rounds off - unless it has a vertex all around which it is flat, and its
/// faces deviate from its plane by far less than they may (the root of their mean square, by area, is at most a quarter
/// of `flatDegrees`; on a curved surface it is more than half). The files' own normals tell bends that are not rounded.
/// Faces so thin that rounding decides their normal are in no region. Throws a usage error for angles out of range.
/// Progress counts faces.
FlatRegions findFlatRegions(const Mesh& mesh, const EdgeTable& edges, const FlatOptions& options, Progress& progress);

}  // namespace shbake
