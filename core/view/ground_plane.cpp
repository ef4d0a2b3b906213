// A plane for a mesh to stand on: the product of two lists of coordinates.
#include "view/ground_plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace shbake {
namespace {

/// Cells along the longer side of what stands on the plane.
constexpr int kFineCells = 64;
/// How much wider each cell further out is: shadows there are of what is far above, and soft.
constexpr double kGrowth = 1.15;

struct Box {
  Vec3d low, high;
};

/// The points' bounding box in axes with z up.
Box boundingBox(std::span<const Vec3d> points, const sh::Matrix3d& toZUp) {
  if (points.empty()) throw usageError("there is nothing to stand on the ground", "give a mesh with vertices");
  Box box{toZUp * points[0], toZUp * points[0]};
  for (const Vec3d& point : points) {
    if (!isFinite(point)) throw usageError("a point above the ground is not finite");
    const Vec3d p = toZUp * point;
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  if (box.low == box.high) throw usageError("what stands on the ground has no size", "give a mesh with faces");
  return box;
}

/// Coordinates `cell` apart from low to high, then farther and farther apart until `reach` beyond either end.
std::vector<double> divisions(double low, double high, double cell, double reach) {
  const int count = std::max(1, static_cast<int>(std::ceil((high - low) / cell)));
  std::vector<double> outwards{0};
  for (double step = cell * kGrowth; outwards.back() < reach; step *= kGrowth) {
    outwards.push_back(outwards.back() + step);
  }
  std::vector<double> all;
  for (std::size_t i = outwards.size() - 1; i > 0; --i) all.push_back(low - outwards[i]);
  for (int i = 0; i <= count; ++i) all.push_back(low + (high - low) * i / count);
  for (std::size_t i = 1; i < outwards.size(); ++i) all.push_back(high + outwards[i]);
  return all;
}

}  // namespace

Mesh groundPlane(std::span<const Vec3d> points, UpAxis up) {
  const sh::Matrix3d axes = axesFor(up);
  const Box box = boundingBox(points, sh::transposed(axes));
  const Vec3d size = box.high - box.low;
  const double diagonal = length(size), around = 0.5 * size.z, z = box.low.z - kGroundGap * diagonal;
  const double cell = std::max({size.x, size.y, 0.5 * size.z}) / kFineCells, reach = kGroundReach * diagonal;
  const std::vector<double> xs = divisions(box.low.x - around, box.high.x + around, cell, reach);
  const std::vector<double> ys = divisions(box.low.y - around, box.high.y + around, cell, reach);

  Mesh plane;
  plane.source = "ground plane";
  plane.doublePositions = true;
  for (const double y : ys) {
    for (const double x : xs) plane.positions.push_back(axes * Vec3d{x, y, z});
  }
  plane.vertexNormals.assign(plane.positions.size(), Vec3f(axes * Vec3d{0, 0, 1}));
  const auto width = static_cast<std::uint32_t>(xs.size());
  for (std::uint32_t j = 0; j + 1 < ys.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t v = j * width + i;
      plane.triangles.push_back({v, v + 1, v + width + 1});
      plane.triangles.push_back({v, v + width + 1, v + width});
    }
  }
  return plane;
}

}  // namespace shbake
