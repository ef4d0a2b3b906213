// Direct transfer of chosen points.
#include "chart/sweep/direct.h"

#include "bake/direct_transfer.h"
#include "bake/flush_denormals.h"
#include "bake/point_tracer.h"
#include "sh/basis.h"

namespace shbake::chart {

std::vector<float> directTransfer(const LightingPoints& points, const RayScene& scene,
                                  std::span<const std::uint32_t> chosen, int order, int rays, std::uint64_t seed,
                                  const Parallel& parallel, Progress& progress) {
  const DirectionSet directions(rays, order);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  std::vector<float> transfer(chosen.size() * count);
  std::vector<PointTracer> tracers;
  std::vector<DirectTransfer> direct(static_cast<std::size_t>(parallel.threads()), DirectTransfer(directions));
  for (int i = 0; i < parallel.threads(); ++i) tracers.emplace_back(points, scene, directions, seed, false);
  parallel.forBlocks(chosen.size(), 4, [&](std::size_t begin, std::size_t end, int worker) {
    const FlushDenormals flush;
    const auto w = static_cast<std::size_t>(worker);
    std::vector<std::uint16_t> sky(static_cast<std::size_t>(directions.groups()));
    for (std::size_t i = begin; i < end; ++i) {
      tracers[w].look(chosen[i], sky);
      direct[w].evaluate({sky, Vec3d(points.pointNormal[chosen[i]]), tracers[w].spin(chosen[i])},
                         {&transfer[i * count], count});
      progress.advance(directions.size());
    }
  });
  return transfer;
}

}  // namespace shbake::chart
