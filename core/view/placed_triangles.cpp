// Clipping in homogeneous coordinates: Sutherland and Hodgman, "Reentrant polygon clipping", CACM 1974; Blinn and
// Newell, "Clipping using homogeneous coordinates", SIGGRAPH 1978.
#include "view/placed_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"

namespace shbake {
namespace {

/// What lies nearer to the eye than this share of the greatest depth is cut off: small enough that nothing is missed,
/// large enough that 1 / depth keeps its digits.
constexpr double kNearest = 1e-6;

/// A point as the camera sees it, before the division by depth, and the colour there.
struct SeenPoint {
  double x = 0, y = 0, depth = 0;  ///< in the picture where |x| and |y| are at most depth
  Rgb color;
};

using Polygon = std::vector<SeenPoint>;

SeenPoint seen(const Camera& camera, const Vec3d& position, const Rgb& color) {
  const Vec3d d = position - camera.eye;
  return {dot(d, camera.right) / camera.tangentX, dot(d, camera.up) / camera.tangentY, dot(d, camera.forward), color};
}

/// Above 0 on the inner side of plane `which` of the frame, linear in the point.
double inside(const SeenPoint& p, int which, double nearest) {
  switch (which) {
    case 0:
      return p.depth - nearest;
    case 1:
      return kFrame * p.depth - p.x;
    case 2:
      return kFrame * p.depth + p.x;
    case 3:
      return kFrame * p.depth - p.y;
    default:
      return kFrame * p.depth + p.y;
  }
}
constexpr int kPlanes = 5;

bool isInside(const SeenPoint& p, double nearest) {
  for (int which = 0; which < kPlanes; ++which) {
    if (!(inside(p, which, nearest) >= 0)) return false;
  }
  return true;
}

/// Where the way from a point inside to one outside leaves; always from the inner one, so that both triangles at an
/// edge compute the same bits.
SeenPoint leaving(const SeenPoint& in, const SeenPoint& out, int which, double nearest) {
  const double a = inside(in, which, nearest), b = inside(out, which, nearest), t = a / (a - b);
  return {in.x + t * (out.x - in.x), in.y + t * (out.y - in.y), in.depth + t * (out.depth - in.depth),
          in.color + (out.color - in.color) * static_cast<float>(t)};
}

Polygon clipped(Polygon polygon, double nearest) {
  for (int which = 0; which < kPlanes && !polygon.empty(); ++which) {
    Polygon rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const SeenPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const bool keepsA = inside(a, which, nearest) >= 0, keepsB = inside(b, which, nearest) >= 0;
      if (keepsA) rest.push_back(a);
      if (keepsA && !keepsB) rest.push_back(leaving(a, b, which, nearest));
      if (!keepsA && keepsB) rest.push_back(leaving(b, a, which, nearest));
    }
    polygon = std::move(rest);
  }
  return polygon;
}

/// The grid of a picture.
struct Grid {
  double stepsX, stepsY;  ///< from the middle to an edge

  PlacedCorner place(const SeenPoint& p) const {
    // A point cut at the frame may lie outside of it by rounding.
    const auto within = [](double v) { return std::clamp(v, -kFrame, kFrame); };
    return {std::llround((1 + within(p.x / p.depth)) * stepsX), std::llround((1 - within(p.y / p.depth)) * stepsY),
            1 / p.depth, p.color};
  }
};

}  // namespace

PlacedTriangles placeTriangles(const Mesh& mesh, std::span<const Rgb> colors, const Camera& camera, int columns,
                               int rows) {
  const Grid grid{0.5 * columns * kGridSteps, 0.5 * rows * kGridSteps};
  std::vector<SeenPoint> points;
  points.reserve(mesh.positions.size());
  double farthest = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    points.push_back(seen(camera, mesh.positions[v], colors[v]));
    if (!std::isfinite(points[v].x + points[v].y + points[v].depth)) {
      throw usageError("vertex " + std::to_string(v) + " is not finite in the axes of the camera");
    }
    farthest = std::max(farthest, points[v].depth);
  }
  const double nearest = std::max(kNearest * farthest, std::numeric_limits<double>::min());

  PlacedTriangles placed;
  std::vector<char> whole;
  whole.reserve(points.size());
  placed.corners.reserve(points.size());
  for (const SeenPoint& p : points) {
    whole.push_back(isInside(p, nearest));
    placed.corners.push_back(whole.back() ? grid.place(p) : PlacedCorner{});
  }
  placed.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    if (whole[t[0]] && whole[t[1]] && whole[t[2]]) {
      placed.triangles.push_back(t);
      continue;
    }
    const Polygon rest = clipped({points[t[0]], points[t[1]], points[t[2]]}, nearest);
    const auto first = static_cast<std::uint32_t>(placed.corners.size());
    for (const SeenPoint& p : rest) placed.corners.push_back(grid.place(p));
    for (std::uint32_t i = 2; i < rest.size(); ++i) placed.triangles.push_back({first, first + i - 1, first + i});
  }
  return placed;
}

}  // namespace shbake
