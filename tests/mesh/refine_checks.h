// What any refinement must keep, checked without what makes it.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/refine.h"

namespace shbake {

/// The mesh refined to one length on two threads.
RefinedMesh refinedTo(const Mesh& mesh, double length, const RefineOptions& options = {});
/// The same to a length that varies.
RefinedMesh refinedBy(const Mesh& mesh, const EdgeLength& length, int threads = 2);

/// The mesh as a file of floats holds it.
Mesh inFloats(Mesh mesh);

double areaOf(const Mesh& mesh);
/// Six times the volume that faces enclose with the origin, divided by six: that of a closed mesh.
double volumeOf(const Mesh& mesh);

/// CHECKs that the vertices of `before` are there in their order, that boundaries and edges of many faces are no longer
/// than before, closed parts closed, and doubled faces doubled; that each new face faces as its source does and lies in
/// its plane as rounding lets it.
void checkKept(const Mesh& before, const RefinedMesh& after);

/// The lengths of all sides of faces that are not in `before`.
std::vector<double> newSides(const Mesh& before, const RefinedMesh& after);

/// Equal geometry, attributes and properties, bit for bit.
bool sameMesh(const Mesh& a, const Mesh& b);

}  // namespace shbake
