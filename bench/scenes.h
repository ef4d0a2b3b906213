// The meshes that benchmarks run on.
#pragma once

#include <string>
#include <vector>

#include "mesh/lighting_points.h"
#include "mesh/mesh.h"

namespace shbake::bench {

/// A mesh by name: a file, or one of the generated ones: city, citycoarse, cavity4, cavity6, bowl, blob5, sphereN.
/// Throws a usage error that lists the names.
Mesh namedMesh(const std::string& name);

/// The lighting points of a mesh by name, of this albedo.
LightingPoints namedPoints(const std::string& name, const Rgb& albedo = {1, 1, 1});

/// The last part of a name that may be a path, for tables.
std::string labelOf(const std::string& name);

/// The names of the meshes that benchmarks run on by default: generated ones, and the scans in `folder` where it
/// exists.
std::vector<std::string> defaultMeshes(const std::string& folder);

}  // namespace shbake::bench
