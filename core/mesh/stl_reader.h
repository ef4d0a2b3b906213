// STL, the format of stereolithography.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/progress.h"
#include "mesh/mesh.h"

namespace shbake {

/// Reads an STL file, ASCII or binary (3D Systems, "StereoLithography interface specification", 1988).
///
/// - Corners at exactly equal positions (-0 equals +0) become one vertex, numbered as they first come.
/// - Facet normals are left out: geometry and winding say the same without rounding.
/// - Binary: the attribute of two bytes is kept as the face property `stl_attribute` (ushort) when any is not zero.
/// Some
///   programs store colours in it, in ways that contradict each other, so it is not taken for one.
/// - ASCII: keywords in any case, any number of solids; loops of more than three vertices become triangles.
///
/// Binary files are told by their size, 84 + 50 bytes a triangle, which no ASCII file below 26 GB can have together
/// with text in the place of the count. Throws an Error naming the line or triangle for what cannot be read.
Mesh readStl(const std::string& path, Progress& progress);

/// True when a file of `size` bytes that begins with `start` (84 bytes or all of it) has the size of a binary STL.
bool isBinaryStl(std::string_view start, std::uint64_t size);

/// True when `start` begins like an ASCII STL: "solid", and no line but its name before "facet" or "endsolid".
bool isAsciiStl(std::string_view start);

}  // namespace shbake
