// OFF, the object file format of Geomview.
#pragma once

#include <string>
#include <string_view>

#include "base/progress.h"
#include "mesh/mesh.h"

namespace shbake {

/// Reads an OFF text file ("The Geomview Manual", Geometry Center, chapter "OFF: object file format") with the header
/// [ST][C][N]OFF, the letters C and N in either order, or none at all.
///
/// - Counts: vertices, faces and, if given, edges (left out). They are checked against the file before room is made.
/// - A vertex: x y z, then with N a normal (nx ny nz), with C a colour (r g b [a] up to the end of the line, before s
/// t), with
///   ST texture coordinates, which become the vertex properties `texture_u` and `texture_v`.
/// - A face: n, n indices from 0, then nothing, r g b [a], or one index of a colour map, which is left out with a
/// warning.
///   Polygons become triangles by triangulatePolygon().
/// - Colours: whole numbers 0..255 are display values, others linear floats (settleTextColors()); a is left out.
/// - Comments from '#' to the end of the line, and blank lines, may stand anywhere.
///
/// Throws an Error naming the line for what cannot be read, and for 4OFF, nOFF and binary OFF.
Mesh readOff(const std::string& path, Progress& progress);

/// True when the first word of a file is a header of OFF, such as "COFF" or "4OFF".
bool isOffHeader(std::string_view word);

}  // namespace shbake
