// Cosine-distributed Hammersley points, turned at each point.
#include <array>

#include "chart/methods/cosine_direction.h"
#include "chart/methods/owen.h"
#include "chart/methods/table_method.h"

namespace shbake::chart {

Estimate estimateCosineHammersley(const TestBed& bed, const Task& task, Progress& progress) {
  const auto set = [](int rays, std::uint64_t) {
    return cosineDirections(rays, [&](int i) {
      return std::array{(i + 0.5) / rays, (sobolBits(static_cast<std::uint32_t>(i), 0) + 0.5) * 0x1p-32};
    });
  };
  return estimateExactly(bed, task, progress, makeSets(task, set, Sets::one));
}

}  // namespace shbake::chart
