// The plain mesh: what a file holds, nothing derived.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "mesh/property.h"

namespace shbake {

/// How stored colours relate to linear light.
enum class ColorEncoding {
  linear,  ///< floats of the file, taken as they stand
  srgb,    ///< 8-bit display values, divided by 255 but not decoded
};

using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh as a file holds it. The triangles are the truth: none is dropped, merged or turned, however
/// degenerate or non-manifold. Arrays marked "or empty" have either the stated size or none.
struct Mesh {
  std::string source;  ///< the file it was read from, for messages and headers

  std::vector<Vec3d> positions;     ///< V points in the file's own axes and units, all finite
  std::vector<Triangle> triangles;  ///< F triples of indices < V
  bool doublePositions = false;     ///< the file's coordinates need double precision; written back as such

  std::vector<Vec3f> vertexNormals;  ///< V normals of any length, or empty
  std::vector<Vec3f> cornerNormals;  ///< 3F normals of any length, or empty; they win over vertexNormals

  std::vector<Rgb> vertexColors;  ///< V colours encoded as `vertexColorEncoding`, 0..1 for 8-bit ones, or empty
  ColorEncoding vertexColorEncoding = ColorEncoding::linear;
  std::vector<Rgb> faceColors;  ///< F colours encoded as `faceColorEncoding`, or empty
  ColorEncoding faceColorEncoding = ColorEncoding::linear;

  /// F indices of the polygon that each triangle came from, or empty when the file had only triangles.
  std::vector<std::uint32_t> sourcePolygons;

  std::vector<Property> vertexProperties;  ///< carried through: V items each (colours too, exactly as stored)
  std::vector<Property> faceProperties;    ///< carried through: F items each (repeated for triangles of one polygon)
  std::vector<PropertyElement> elements;   ///< elements that are neither vertices nor faces
  std::vector<std::string> comments;       ///< header comments, without the word "comment"
  std::vector<std::string> warnings;       ///< what reading had to assume or leave out, one sentence each
};

}  // namespace shbake
