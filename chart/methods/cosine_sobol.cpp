// Cosine-distributed directions from Sobol' points with Owen's scrambling.
#include <array>

#include "base/hash.h"
#include "chart/methods/cosine_direction.h"
#include "chart/methods/owen.h"
#include "chart/methods/table_method.h"

namespace shbake::chart {

Estimate estimateCosineSobol(const TestBed& bed, const Task& task, Progress& progress) {
  const auto set = [](int rays, std::uint64_t seed) {
    const auto coordinate = [&](int i, int dimension) {
      const auto scramble = hashBits(seed, static_cast<std::uint64_t>(dimension));
      return (owenScrambled(sobolBits(static_cast<std::uint32_t>(i), dimension), scramble) + 0.5) * 0x1p-32;
    };
    return cosineDirections(rays, [&](int i) { return std::array{coordinate(i, 0), coordinate(i, 1)}; });
  };
  return estimateExactly(bed, task, progress, makeSets(task, set, Sets::several));
}

}  // namespace shbake::chart
