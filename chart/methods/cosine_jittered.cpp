// Cosine-distributed directions, one at random in each cell of a grid.
#include <array>
#include <cmath>

#include "base/hash.h"
#include "chart/methods/cosine_direction.h"
#include "chart/methods/table_method.h"

namespace shbake::chart {

Estimate estimateCosineJittered(const TestBed& bed, const Task& task, Progress& progress) {
  const auto set = [](int rays, std::uint64_t seed) {
    // The most nearly square grid whose cells are as many as the rays.
    int rows = static_cast<int>(std::sqrt(rays));
    while (rays % rows != 0) --rows;
    const int columns = rays / rows;
    return cosineDirections(rays, [&](int i) {
      const auto index = static_cast<std::uint64_t>(i);
      return std::array{(i % rows + hashUnit(seed, 2 * index)) / rows,
                        (i / rows + hashUnit(seed, 2 * index + 1)) / columns};
    });
  };
  return estimateExactly(bed, task, progress, makeSets(task, set, Sets::several));
}

}  // namespace shbake::chart
