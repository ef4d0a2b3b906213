// Rows of points along both sides of lines on a plane patch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/patch_mesher.h"
#include "mesh/patch_points.h"

namespace shbake {

/// Places joined one after the other, and the last to the first where closed (which is not repeated).
struct PatchLine {
  std::vector<Point2> places;  ///< at least two
  bool closed = false;
};

struct PatchRows {
  std::vector<PatchPoint> points;
  std::vector<std::array<std::uint32_t, 2>> joints;  ///< pairs of points that follow each other in a row
  std::vector<PatchObstacle> pieces;  ///< what lies between neighbours of a row, and single points: for spreadPoints()
};

/// Points at `offset` from the lines, two by two across them: a value that jumps at a line stays on its side. Along a
/// line they are as far apart as `length` asks at most; turns that stand out from the row by less than a small part of
/// that are passed over. A line has rows where `length` is finite anywhere on it, on the whole of it: where it is
/// infinite, the more widely spaced the farther away. There are no points outside the patch, nor nearer to an obstacle
/// or another row than a few offsets.
PatchRows rowsBeside(PatchLocator& patch, std::span<const PatchLine> lines, double offset,
                     std::span<const PatchObstacle> obstacles, const PatchLength& length);

}  // namespace shbake
