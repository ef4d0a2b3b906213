// Our own: the classes that `shbake bake` runs, on chosen points.
#include "bake/direct_transfer.h"
#include "bake/point_tracer.h"
#include "chart/methods/method.h"
#include "chart/methods/table_method.h"
#include "sh/basis.h"

namespace shbake::chart {

Estimate estimateShbake(const TestBed& bed, const Task& task, Progress& progress) {
  const LightingPoints& points = bed.points();
  const DirectionSet directions(task.rays, task.order);
  PointTracer tracer(points, bed.exact(), directions, task.seed, false);
  DirectTransfer direct(directions);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(task.order));
  std::vector<std::uint16_t> sky(static_cast<std::size_t>(directions.groups()));
  Estimate result;
  result.transfer.resize(task.chosen.size() * count);
  const double cpu = timedOverPoints(task.chosen, progress, [&](std::uint32_t p, std::size_t i) {
    tracer.look(p, sky);
    direct.evaluate(sky, Vec3d(points.pointNormal[p]), tracer.spin(p), {&result.transfer[i * count], count});
  });
  const double scale = static_cast<double>(points.size()) / static_cast<double>(task.chosen.size());
  result.cpu = cpu * scale + bed.contactSeconds();
  result.rays = directions.size();
  return result;
}

}  // namespace shbake::chart
