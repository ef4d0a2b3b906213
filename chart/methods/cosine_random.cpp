// Independent cosine-distributed directions.
#include <array>

#include "base/hash.h"
#include "chart/methods/cosine_direction.h"
#include "chart/methods/table_method.h"

namespace shbake::chart {

Estimate estimateCosineRandom(const TestBed& bed, const Task& task, Progress& progress) {
  const auto set = [](int rays, std::uint64_t seed) {
    return cosineDirections(rays, [&](int i) {
      const auto index = static_cast<std::uint64_t>(i);
      return std::array{hashUnit(seed, 2 * index), hashUnit(seed, 2 * index + 1)};
    });
  };
  return estimateExactly(bed, task, progress, makeSets(task, set, Sets::several));
}

}  // namespace shbake::chart
