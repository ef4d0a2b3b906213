#include "reference.h"

#include <algorithm>
#include <limits>

#include "bake/direct_transfer.h"
#include "bake/point_tracer.h"
#include "base/progress.h"
#include "sh/basis.h"

namespace shbake::bench {
namespace {

/// A seed that no bake uses by default, so that the reference is independent of what it judges.
constexpr std::uint64_t kSeed = 0x5EED;

}  // namespace

std::vector<std::uint32_t> choosePoints(const LightingPoints& points, std::size_t count) {
  std::vector<std::uint32_t> chosen;
  const std::size_t n = std::min(count, points.size());
  for (std::size_t i = 0; i < n; ++i) chosen.push_back(static_cast<std::uint32_t>(i * points.size() / n));
  return chosen;
}

std::vector<double> directReference(const LightingPoints& points, const std::vector<std::uint32_t>& chosen, int order,
                                    int rays, const Parallel& parallel) {
  Progress progress;
  const RayScene scene(points, std::numeric_limits<float>::infinity(), parallel, progress);
  const DirectionSet directions(rays, order);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  std::vector<double> reference(chosen.size() * count);
  parallel.forBlocks(chosen.size(), 4, [&](std::size_t begin, std::size_t end, int) {
    const FlushDenormals flush;
    PointTracer tracer(points, scene, directions, kSeed, false);
    DirectTransfer direct(directions);
    std::vector<std::uint16_t> sky(static_cast<std::size_t>(directions.groups()));
    std::vector<float> out(count);
    for (std::size_t i = begin; i < end; ++i) {
      tracer.look(chosen[i], sky);
      direct.evaluate(sky, Vec3d(points.pointNormal[chosen[i]]), tracer.spin(chosen[i]), out);
      std::copy(out.begin(), out.end(), &reference[i * count]);
    }
  });
  return reference;
}

}  // namespace shbake::bench
