// The triangles of a mesh in a picture: projected onto its grid, and cut where they reach behind the camera.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "mesh/mesh.h"
#include "view/camera.h"

namespace shbake {

/// A vertex in the picture.
struct PlacedCorner {
  std::int64_t x = 0, y = 0;  ///< in steps of 1 / kGridSteps sample from the upper left corner, y downwards
  double inverseDepth = 0;    ///< 1 / Camera::Projected::depth, above 0
  Rgb color;
};

struct PlacedTriangles {
  std::vector<PlacedCorner> corners;
  std::vector<Triangle> triangles;  ///< of corners; in the order of the mesh
};

/// Steps of the grid in a sample.
inline constexpr std::int64_t kGridSteps = 256;
/// Triangles are cut where they leave a frame this many times as wide and high as the picture: with at most 2^18
/// samples a side, places stay below 2^30 steps and their products below 2^63.
inline constexpr double kFrame = 8;

/// Places the triangles in a picture of `columns` x `rows` samples. A triangle that reaches behind the camera or out of
/// the frame is replaced by the triangles of what is left of it, colours interpolated linearly along its edges; those
/// that share an edge are cut at the same points, so that no gap opens. Positions that are not finite are refused with
/// a usage error.
PlacedTriangles placeTriangles(const Mesh& mesh, std::span<const Rgb> colors, const Camera& camera, int columns,
                               int rows);

}  // namespace shbake
