// Single surfaces with known properties: closed, convex, concave, open. Positions are doubles; faces are wound
// counter-clockwise seen from their front; no shape has normals or colours unless it says so.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "mesh/mesh.h"

namespace shbake::shapes {

/// A flat parallelogram with corners o, o+u, o+u+v, o+v and its front towards u x v, in nu x nv cells of two triangles.
/// Vertex j*(nu+1)+i lies at o + u*i/nu + v*j/nv. Requires nu, nv >= 1.
Mesh grid(Vec3d o, Vec3d u, Vec3d v, int nu = 1, int nv = 1);

/// The box from `lo` to `hi` seen from outside, welded: each side in cells[axis] strips along each axis.
Mesh box(Vec3d lo, Vec3d hi, std::array<int, 3> cells = {1, 1, 1});

/// The unit cube around the origin with 8 shared vertices.
Mesh cube();

/// The same cube with 24 vertices: four for each side.
Mesh cubeSplit();

/// The unit cube around the origin seen from inside, each side in n x n cells (n = 1: 12 triangles), welded.
Mesh boxRoom(int n = 1);

/// A unit sphere of 20 * 4^level triangles around the origin, its vertices moved to radius 1 + displacement *
/// smoothNoise. Convex where `displacement` is 0. Level 0..9.
Mesh icosphere(int level, double displacement = 0);

/// The icosphere seen from inside.
Mesh inwardSphere(int level, double displacement = 0);

/// The inside of a unit sphere around the origin, open at the top: all polar angles from `aperture` (radians from +z,
/// the half-angle of the hole) to pi in `rings` rings of `sectors` quads. Vertices lie on the sphere to rounding; the
/// last one is the pole at -z. With `normals`, vertexNormals hold the exact inward normals.
Mesh bowl(double aperture, int rings, int sectors, bool normals = false);

/// An inward sphere whose faces with a centroid within `holeDegrees` of +z are left out: an open cavity, a single
/// sheet.
Mesh openCavity(int level, double displacement, double holeDegrees);

/// The three unit squares that meet at the origin, facing the inside of the positive octant, n x n cells each, welded.
/// Vertex 0 is the corner.
Mesh corner(int n = 1);

/// Two cones of height h on a regular polygon of n corners in the unit circle, base to base: corners 0..n-1, then the
/// upper apex n, then the lower n+1. Convex; a fan of slivers for large n, an elongated solid for large h.
Mesh bicone(int n, double h);

Mesh tetrahedron();  ///< regular, with corners on the unit sphere
Mesh octahedron();   ///< regular, with corners on the unit sphere

/// A surface of revolution around z from `profile`, pairs (radius, z) from bottom to top with positive radii, in
/// `sectors` strips, closed by a fan at both ends and seen from outside.
Mesh lathe(const std::vector<std::array<double, 2>>& profile, int sectors);

/// Solids on whose every vertex an occlusion test must find nothing above the vertex's own faces.
std::vector<Mesh> convexSolids();

/// A smooth function of space with features of about a quarter of the unit sphere's size, in -2..2.
double smoothNoise(Vec3d p);

}  // namespace shbake::shapes
