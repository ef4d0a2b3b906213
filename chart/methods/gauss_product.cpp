// The product rule: Gauss-Legendre in u = cos^2(theta), in which the cosine-weighted hemisphere is uniform, times equal
// steps in azimuth.
#include <cmath>
#include <numbers>

#include "chart/methods/table_method.h"
#include "sh/quadrature.h"

namespace shbake::chart {

Estimate estimateGaussProduct(const TestBed& bed, const Task& task, Progress& progress) {
  const auto set = [](int rays, std::uint64_t) {
    // Rings of the disc are on average 4 times as long, in steps, as it has rings: about sqrt(rays / 4) of these.
    int rings = std::max(1, static_cast<int>(std::sqrt(rays / 4.0)));
    while (rays % rings != 0) --rings;
    const int azimuths = rays / rings;
    const sh::IntervalRule rule = sh::gaussLegendre(rings);
    std::vector<WeightedDirection> all;
    for (std::size_t ring = 0; ring < rule.nodes.size(); ++ring) {
      const double u = (rule.nodes[ring] + 1) / 2, r = std::sqrt(1 - u);
      for (int a = 0; a < azimuths; ++a) {
        const double phi = 2 * std::numbers::pi * (a + 0.5) / azimuths;
        all.push_back({{r * std::cos(phi), r * std::sin(phi), std::sqrt(u)}, rule.weights[ring] / 2 / azimuths});
      }
    }
    return all;
  };
  return estimateExactly(bed, task, progress, makeSets(task, set, Sets::one));
}

}  // namespace shbake::chart
