// How many vertices of a mesh get the wrong light, from shbake and from a naive baker.
#pragma once

#include <cstddef>
#include <vector>

#include "stability/row.h"
#include "support/transforms.h"

namespace shbake::stability {

/// How a naive baker keeps a ray from hitting the surface that it starts on. All work in single precision on the file's
/// coordinates, by the algorithm of Moeller and Trumbore ("Fast, minimum storage ray/triangle intersection", 1997).
enum class SelfHits {
  counted,         ///< every hit in front of the vertex counts
  nearOnes,        ///< hits nearer than 1e-4 of the bounding box's diagonal do not count
  nearOnesByUnit,  ///< hits nearer than 1e-4 of the file's units do not count
  originMoved,     ///< the ray starts 1e-4 of the diagonal above the vertex, along its normal
  facesOfVertex,   ///< faces that have the ray's vertex as a corner do not count
};

/// Where a mesh is put before it is baked: what a user's file does to exact coordinates.
struct Placement {
  shapes::Matrix3 rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double scale = 1;
  Vec3d offset{};
};

/// A turn by no round angle about no axis; number 0 is none.
Placement turned(int number);

struct SkyCase {
  Mesh mesh;  ///< as it is exactly, so that what touches touches
  Placement placement{};
  SelfHits naive = SelfHits::nearOnes;
  std::size_t vertices = 24;  ///< judged at most, spread evenly over the mesh
};

/// Bakes the placed mesh by shadowed transfer of order 3 and counts the vertices whose transfer is off by more than
/// kNoticeable from the oracle's. The naive baker uses the same normals, and the oracle's own directions, so that
/// nothing but its self-hits can be wrong.
Outcome judgeSky(const SkyCase& c, const Bench& bench);

/// The sum over several.
Outcome judgeSkies(const std::vector<SkyCase>& cases, const Bench& bench);

}  // namespace shbake::stability
