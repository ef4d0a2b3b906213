// The mesh to bake and its blockers as one mesh.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/lighting_points.h"
#include "mesh/mesh.h"
#include "pipeline/albedo.h"

namespace shbake {

/// Everything that takes part in the transport of light: the mesh's vertices and faces first, then the blockers'.
struct Scene {
  Mesh mesh;  ///< positions, triangles and normals only
  Albedo albedo;
};

/// Joins `mesh` and its blockers. Where the two have albedo of different kinds, the mesh's is kept exactly and a
/// blocker's is averaged to that kind (over a face's corners, or over the faces around a vertex).
Scene joinScene(const Mesh& mesh, const Albedo& albedo, const std::vector<Mesh>& blockers,
                const std::vector<Albedo>& blockerAlbedos);

}  // namespace shbake
