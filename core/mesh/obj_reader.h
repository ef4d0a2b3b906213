// Wavefront OBJ.
#pragma once

#include <string>

#include "base/progress.h"
#include "mesh/mesh.h"

namespace shbake {

/// Reads the polygons of an OBJ file (Wavefront, "Object Files", Advanced Visualizer manual, appendix B1).
///
/// - `v x y z [w]`: w is left out. `v x y z r g b [a]`: vertex colours, encoded as settleTextColors() finds; a is left
/// out.
/// - `f` with v, v/vt, v//vn or v/vt/vn at each corner; indices count from 1 or, negative, back from the last one so
/// far,
///   and may refer to lines further down. Polygons become triangles by triangulatePolygon().
/// - `vn` at corners become cornerNormals; corners without one get the zero vector.
/// - `vt` at corners become the face property `texcoord`, a list of 6 floats (u, v of each corner) as MeshLab keeps it;
///   corners without one get 0, 0.
/// - `mtllib`, `usemtl`: Kd becomes faceColors (linear; faces without one are white). Each map_Kd in use becomes a
/// comment
///   "TextureFile NAME", and with several of them the face property `texnumber` (int) counts them from 0 (-1: none).
///   A material file that is missing or cannot be read is a warning.
/// - Objects, groups and smoothing groups are ignored: normals come from `vn` or from the crease angle. Lines, points
/// and
///   free-form statements hold no polygons and are passed over with a warning.
///
/// Throws an Error naming the line for numbers that cannot be read or are not finite and indices out of range.
Mesh readObj(const std::string& path, Progress& progress);

}  // namespace shbake
