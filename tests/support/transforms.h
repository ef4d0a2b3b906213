// Meshes made from meshes: moved, scaled, turned, shuffled, joined.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake::shapes {

/// Rows of a 3 x 3 matrix.
using Matrix3 = std::array<Vec3d, 3>;

Mesh scaled(Mesh mesh, double factor);
Mesh translated(Mesh mesh, Vec3d offset);
/// Positions and normals times a rotation matrix.
Mesh rotated(Mesh mesh, const Matrix3& rotation);
/// Every face wound the other way, and normals reversed.
Mesh flipped(Mesh mesh);
/// Vertices and faces of `a`, then of `b`. Normals and colours are kept where both have them.
Mesh merged(const Mesh& a, const Mesh& b);
/// Without the vertices that no face uses; positions and vertexNormals follow.
Mesh compacted(const Mesh& mesh);
/// Linear face colour `color` for all faces.
Mesh colored(Mesh mesh, Rgb color);

/// The rotation by `radians` about `axis` (of any length but zero), counter-clockwise seen against the axis.
Matrix3 rotationAbout(Vec3d axis, double radians);
Vec3d apply(const Matrix3& matrix, Vec3d v);

struct Shuffled {
  Mesh mesh;
  std::vector<std::uint32_t> vertexSource;  ///< vertex i of `mesh` is this vertex of the original
  std::vector<std::uint32_t> faceSource;    ///< face i of `mesh` is this face of the original
};
/// Vertices and faces in a random order, and the corners of each face turned at random without changing its winding.
Shuffled shuffled(const Mesh& mesh, std::uint64_t seed);

}  // namespace shbake::shapes
