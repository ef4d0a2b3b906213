#include "pipeline/light_order.h"

#include <algorithm>
#include <cmath>

#include "bake/baker.h"
#include "bake/pilot.h"
#include "bake/stated_error.h"

namespace shbake {
namespace {

/// Rays that leave less noise in the higher bands than the transfer has there.
constexpr int kRays = 256;

/// The squares of each band's coefficients.
std::array<double, LightOrder::kMost> bandSquares(std::span<const float> transfer) {
  std::array<double, LightOrder::kMost> squares{};
  for (std::size_t l = 0; l < squares.size(); ++l) {
    for (std::size_t i = l * l; i < (l + 1) * (l + 1); ++i) squares[l] += std::pow(static_cast<double>(transfer[i]), 2);
  }
  return squares;
}

}  // namespace

LightOrder chooseOrder(TracedPoints& traced, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
                       const Light& light, double tolerance, const Parallel& parallel, Progress& progress) {
  const LightingPoints& points = traced.points();
  std::vector<std::uint8_t> pilot(points.size(), 0);
  const std::vector<std::uint32_t> chosen = pilotPoints(points, wanted);
  for (const std::uint32_t p : chosen) pilot[p] = 1;
  BakeOptions direct = options;
  direct.order = LightOrder::kMost;
  direct.rays = kRays;
  if (direct.kind == TransferKind::interreflected) direct.kind = TransferKind::shadowed;
  const TransferSet baked = bakePoints(traced, pilot, direct, parallel, progress).transfer;

  const std::vector<Vec3d> lightBands = bandEnergies(withOrder(light, LightOrder::kMost));
  const std::vector<double> areas = pointAreas(points);
  std::array<double, LightOrder::kMost> seen{};  // the mean square of what each band brings to pictures
  for (const std::uint32_t p : chosen) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto squares = bandSquares(baked.at(p, baked.channels == 3 ? static_cast<int>(c) : 0));
      for (std::size_t l = 0; l < seen.size(); ++l) {
        const Vec3d& band = lightBands[l];
        const double energy = c == 0 ? band.x : c == 1 ? band.y : band.z;
        seen[l] += areas[p] * energy * squares[l] / static_cast<double>(2 * l + 1);
      }
    }
  }
  LightOrder result;
  double total = 0, tail = 0;
  for (const double s : seen) total += s;
  for (std::size_t n = seen.size(); n-- > 0;) {
    result.left[n] = total > 0 ? std::sqrt(tail / total) : 0;
    if (result.left[n] <= tolerance) result.order = static_cast<int>(n) + 1;
    tail += seen[n];
  }
  return result;
}

}  // namespace shbake
