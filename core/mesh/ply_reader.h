// PLY files to meshes.
#pragma once

#include <string>

#include "base/progress.h"
#include "mesh/mesh.h"

namespace shbake {

/// Reads a PLY file (ASCII, binary little or big endian). What becomes of its parts:
/// - vertex x, y, z of any scalar type: positions; doublePositions where one of them is a double or a 32-bit integer,
///   which a float cannot hold.
/// - vertex nx, ny, nz as float or double: vertexNormals.
/// - red, green, blue as uchar (sRGB) or as float or double (linear), of vertices or faces: vertexColors or faceColors,
///   and also the properties that they are, so that nothing is lost when they are written again.
/// - face list vertex_indices (or vertex_index) of any integer type: triangles; polygons are cut by
///   triangulatePolygon() and recorded in sourcePolygons, and their properties are repeated for each triangle.
/// - face uint source_polygon, as writePly() writes it: sourcePolygons. Face list corner_normals of 9 floats, likewise:
///   cornerNormals (in files of triangles only).
/// - tristrips list vertex_indices, with -1 between strips: triangles, every other one turned. Strips repeat vertices
/// to
///   jump; the triangles without area that this makes (an index twice) are no part of the surface and left out.
/// - everything else: vertexProperties, faceProperties, elements, comments (obj_info lines as comments that begin with
///   this word).
/// Throws an Error that names the place ("vertex 7", "face 3", "header line 5") for whatever cannot be understood: see
/// PlyBody and readPlyHeader(), and further: no vertices declared, missing or non-finite coordinates, indices out of
/// range, faces of fewer than three vertices (which other programs drop or choke on, each in its own way), more
/// vertices or faces than 32-bit indices count, both faces and tristrips. Progress counts bytes.
Mesh readPly(const std::string& path, Progress& progress);

}  // namespace shbake
