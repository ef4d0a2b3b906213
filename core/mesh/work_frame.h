// The frame in which geometry is compared: the same for a mesh however it is scaled, and free of large offsets.
#pragma once

#include "base/passes.h"
#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake {

/// The frame in which geometry is welded, traced and compared: centred on the bounding box and scaled by a power of two
/// so that the largest half-extent is in (0.5, 1]. Scaling is exact; centring rounds once, to float.
struct WorkFrame {
  Vec3d centre;
  double scale = 1;  ///< work units per file unit: a power of two

  /// Work coordinates never hold a negative zero, so that equal positions have equal bits.
  Vec3f toWork(const Vec3d& p) const { return Vec3f((p - centre) * scale) + Vec3f(); }
  /// The way back, in double precision.
  Vec3d toFile(const Vec3d& p) const { return p * (1 / scale) + centre; }
};

/// The work frame of a mesh: its bounding box is that of the vertices which faces use. Scale 1 where they all coincide.
/// Requires at least one face, indices < V and finite positions. One pass.
WorkFrame workFrameOf(const Mesh& mesh, Passes& passes);

}  // namespace shbake
