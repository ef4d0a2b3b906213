// The loop of libigl's ambient occlusion by Embree, given SH sums: one stratified random set of directions of the
// sphere for all points, folded into each point's hemisphere, and nearest-hit rays whose origin is moved along them by
// 1e-4 of the file's units.
#include <cmath>

#include "base/hash.h"
#include "chart/methods/sphere_table.h"
#include "chart/methods/table_method.h"
#include "sh/basis.h"

namespace shbake::chart {
namespace {

constexpr double kShift = 1e-4;  // file units

/// A grid of floor(sqrt(n)) squared cells with a direction at random in each, then independent ones up to n; behind
/// them their opposites in the same order.
std::vector<Vec3d> foldableSet(int n, std::uint64_t seed) {
  const int side = static_cast<int>(std::sqrt(n));
  std::vector<Vec3d> all;
  for (int i = 0; i < n; ++i) {
    const double a = hashUnit(seed, 2 * static_cast<std::uint64_t>(i));
    const double b = hashUnit(seed, 2 * static_cast<std::uint64_t>(i) + 1);
    const bool inGrid = i < side * side;
    all.push_back(inGrid ? sphereDirection((i / side + a) / side, (i % side + b) / side) : sphereDirection(a, b));
  }
  for (int i = 0; i < n; ++i) all.push_back(-all[static_cast<std::size_t>(i)]);
  return all;
}

}  // namespace

Estimate estimateLibigl(const TestBed& bed, const Task& task, Progress& progress) {
  const LightingPoints& points = bed.points();
  const SphereTable table(foldableSet(task.rays, task.seed), task.order);
  const auto n = static_cast<std::size_t>(task.rays);
  const auto shift = static_cast<float>(kShift * points.frame.scale);
  const RTCScene scene = bed.bare().scene();
  const auto count = static_cast<std::size_t>(sh::coefficientCount(task.order));
  SphereSum sum(table);
  Estimate result;
  result.transfer.resize(task.chosen.size() * count);
  const double cpu = timedOverPoints(task.chosen, progress, [&](std::uint32_t p, std::size_t c) {
    const Vec3f normal = points.pointNormal[p], o = points.positions[points.pointPosition[p]];
    sum.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const bool below = dot(table.direction(i), normal) < 0;
      const std::size_t folded = below ? n + i : i;
      const Vec3f d = table.direction(folded);
      if (!hasHit(scene, rayFrom(o + d * shift, 0, d, 0))) sum.add(folded, dot(d, normal));
    }
    sum.finish(2.0 / task.rays, {&result.transfer[c * count], count});  // 1/pi times 2 pi / N
  });
  result.cpu = cpu * static_cast<double>(points.size()) / static_cast<double>(task.chosen.size());
  result.rays = task.rays;
  return result;
}

}  // namespace shbake::chart
