// R. Green, "Spherical Harmonic Lighting: The Gritty Details", 2003: jittered directions over the whole sphere, shared
// by all points; those above the tangent plane are traced one by one and leave out the faces around the vertex. Given
// here: Embree, its filter for that rule, float sums, and the factor 1/pi that his code omits.
#include <cmath>

#include "base/hash.h"
#include "chart/methods/sphere_table.h"
#include "chart/methods/table_method.h"
#include "sh/basis.h"

namespace shbake::chart {

Estimate estimateGreen(const TestBed& bed, const Task& task, Progress& progress) {
  const LightingPoints& points = bed.points();
  int rows = static_cast<int>(std::sqrt(task.rays));
  while (task.rays % rows != 0) --rows;
  const int columns = task.rays / rows;
  std::vector<Vec3d> directions;
  for (int i = 0; i < task.rays; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    directions.push_back(sphereDirection((i % columns + hashUnit(task.seed, 2 * index)) / columns,
                                         (i / columns + hashUnit(task.seed, 2 * index + 1)) / rows));
  }
  const SphereTable table(directions, task.order);
  const EmbreeScene& scene = bed.neighboursOut();
  const auto count = static_cast<std::size_t>(sh::coefficientCount(task.order));
  SphereSum sum(table);
  Estimate result;
  result.transfer.resize(task.chosen.size() * count);
  const double cpu = timedOverPoints(task.chosen, progress, [&](std::uint32_t p, std::size_t c) {
    const Vec3f n = points.pointNormal[p], o = points.positions[points.pointPosition[p]];
    sum.clear();
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float h = dot(table.direction(i), n);
      if (h <= 0) continue;
      result.rays += 1;
      const RTCRay ray = rayFrom(o, scene.nearDistance(), table.direction(i), points.pointPosition[p]);
      if (!isOccluded(scene.scene(), ray)) sum.add(i, h);
    }
    sum.finish(4.0 / task.rays, {&result.transfer[c * count], count});  // 1/pi times 4 pi / N
  });
  const auto chosen = static_cast<double>(task.chosen.size());
  result.cpu = cpu * static_cast<double>(points.size()) / chosen;
  result.rays /= chosen;
  return result;
}

}  // namespace shbake::chart
