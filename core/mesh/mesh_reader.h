// Mesh files of every kind that shbake reads.
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/mesh.h"

namespace shbake {

/// Reads a mesh from a PLY, OBJ, OFF or STL file, told apart by what the file holds and, where that leaves doubt, by
/// the ending of its name. docs/reading.md states the rules of each format. Throws an Error that names the file, the
/// place in it, what is wrong and what to do; of kind `cancelled` when `progress` says so.
Mesh readMesh(const std::string& path, Progress& progress);

/// The endings of file names that readMesh() knows, in lower case without the dot: "ply", "obj", ….
std::vector<std::string> readableExtensions();

}  // namespace shbake
