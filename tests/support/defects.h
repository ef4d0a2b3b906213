// Meshes named by their defect: what real files hold and a half-edge structure alone would drop or repeat.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace shbake::shapes {

Mesh threeFacesOnEdge();        ///< three triangles on the edge 0-1: along +x, at 120 degrees, at 240 degrees around z
Mesh bowTie();                  ///< two flat triangle fans in z = 0 that share only vertex 0
Mesh conesTipToTip();           ///< two open cones, whose only common vertex is 0: a bow-tie of closed fans
Mesh moebiusStrip(int n = 24);  ///< n quads once around with half a twist; no consistent winding exists
Mesh duplicateFaces();          ///< an octahedron with every face twice
Mesh doubledSheet(int n = 3);   ///< a grid and its flipped copy on the same vertices
Mesh flippedFaces(int level = 2, int every = 5);  ///< an icosphere with each `every`-th face wound the wrong way
Mesh degenerateFaces();   ///< a quad, a face with a repeated index, a face with two equal positions, a face that is a
                          ///< point
Mesh collinearFace();     ///< a flat square split so that one triangle has three different corners on one line
Mesh isolatedVertices();  ///< a triangle between vertices that no face uses, which lie far away
Mesh onlyDegenerate();    ///< two faces, both without distinct corners

/// All of the above.
std::vector<Mesh> defects();

}  // namespace shbake::shapes
