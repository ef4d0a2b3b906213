// How an image covers the sphere of directions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// Layouts of environment maps. All are seen from the inside and unmirrored, F = forward, R = right, U = up:
/// the image of the forward direction has R to its right and U above.
enum class MapLayout {
  automatic,        ///< told by the file's own attribute, else by width : height
  latLong,          ///< width = longitude, height = latitude; row 0 is U, the centre F (2:1)
  angular,          ///< angular map or "light probe": centre F, distance from it = angle, the rim is -F (1:1)
  crossHorizontal,  ///< cube unfolded to 4x3 faces: row 1 is left, front, right, back; up above and down below front
  crossVertical,    ///< 3x4 faces: column 1 is up, front, down, back (upside down); left and right beside front
  stripHorizontal,  ///< cube as 6x1 faces: right, left, up, down, front, back, each as in crossHorizontal
  stripVertical,    ///< the same faces as 1x6
  openexrCube,      ///< 1x6 faces of OpenEXR, whose axes are x = -R, y = U, z = F: left, right, up, down, front, back
};

/// Its name on the command line, such as "lat-long".
const char* layoutName(MapLayout layout);
/// The inverse; empty for a word that is no layout.
std::optional<MapLayout> layoutNamed(const std::string& name);
/// All names in the order of the enumeration.
std::vector<std::string> layoutNames();

/// The layout that has this width : height: 2:1 lat-long, 1:1 angular, 4:3 and 3:4 crosses, 6:1 and 1:6 strips; empty
/// for any other shape.
std::optional<MapLayout> guessLayout(int width, int height);

/// One face of a cube map, or an angular map: a square of pixels and the axes of the viewer's frame that it looks
/// along, in the canonical frame F = +x, R = -y, U = +z.
struct CubeFace {
  int x = 0, y = 0, size = 0;  ///< its left upper pixel and its width in pixels
  Vec3d forward, right, up;    ///< the directions of its centre, and rightwards and upwards in the image
};

/// The six faces of a cube layout, or the one square of an angular map, whose axes are those of its centre. Throws an
/// Error without a file name when the image does not have the shape that the layout asks for (an angular map has at
/// least 4 pixels across), a usage error for other layouts.
std::vector<CubeFace> mapCharts(MapLayout layout, int width, int height);

}  // namespace shbake
