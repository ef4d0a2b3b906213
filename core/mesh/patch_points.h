// Points spread over a plane patch as densely as asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/patch_mesher.h"

namespace shbake {

/// Edges are left as they are up to this multiple of the length wanted: halves of longer ones are nearer to it.
inline constexpr double kLongestEdge = 1.4142135623730951;

/// The steepest that lengths are expected to change with distance.
inline constexpr double kSteepest = 0.5;

/// What new points keep away from: a piece of the border or of a row, or a point (a = b).
struct PatchObstacle {
  Point2 a, b;
  double length = 0;     ///< of edges wanted there
  double clearance = 0;  ///< that new points keep at least, however short edges are wanted
};

double distanceTo(const PatchObstacle& obstacle, Point2 place);

/// A new point of a patch, and the face of it that it lies in.
struct PatchPoint {
  Point2 place;
  std::uint32_t face = 0;
};

/// The length of edges wanted at a place of a face of the patch; positive, may be infinite.
using PatchLength = std::function<double(std::uint32_t face, Point2 place)>;

/// Points inside a patch that stand about as far apart as `length` asks: the corners of equilateral triangles that are
/// halved until they are short enough, on a lattice with the origin on it and rows along x. For a constant length the
/// triangles have just that side. Points nearer to an obstacle than half the height of their triangle are left out.
/// They come in an order in which neighbours follow each other. `count` is called with the points found so far
/// unreported.
std::vector<PatchPoint> spreadPoints(PatchLocator& patch, std::span<const PatchObstacle> obstacles,
                                     const PatchLength& length, const PointCounter& count);

}  // namespace shbake
