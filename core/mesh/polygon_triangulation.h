// Cutting polygons into triangles without leaving a concave outline.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// Replaces `out` by the n - 2 triangles of a polygon with n corners, as indices 0..n-1 in the polygon's own winding;
/// fewer than 3 corners give none. Seen along its mean normal (Newell's), a simple polygon is covered exactly, concave
/// or not, with holes bridged by doubled edges or not. The plain fan (0, i, i+1) is kept wherever it covers the
/// polygon, so that convex polygons come out as other programs cut them. A polygon whose outline crosses itself or has
/// no area still gives n - 2 triangles. Linear time for fans; else a sorted search, O(n log n) for well-behaved
/// outlines and O(n^2) at worst.
void triangulatePolygon(std::span<const Vec3d> corners, std::vector<std::array<std::uint32_t, 3>>& out);

}  // namespace shbake
