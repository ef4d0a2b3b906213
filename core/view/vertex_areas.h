// How much surface belongs to each vertex.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace shbake {

/// A third of the area of the triangles around each vertex, in the file's units squared: the integral of the function
/// that is 1 at the vertex, 0 at the others and linear between.
std::vector<double> vertexAreas(const Mesh& mesh);

}  // namespace shbake
