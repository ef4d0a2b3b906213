#include "bake/stated_error.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "sh/irradiance.h"

namespace shbake {

int boundaryPairs(std::span<const std::uint16_t> sky) {
  int pairs = 0;
  for (const unsigned m : sky) {
    pairs += std::popcount((m ^ (m >> 1)) & 0x7777u) + std::popcount((m ^ (m >> 4)) & 0x0FFFu);
  }
  return pairs;
}

double directError(int pairs, int rays, int order) {
  const double perCell = order / std::sqrt(4 * std::numbers::pi);
  return std::sqrt(0.1 * pairs) * perCell / rays / sh::unshadowedNorm(order);
}

std::vector<double> pointAreas(const LightingPoints& points) {
  std::vector<double> areas(points.size(), 0);
  for (std::size_t f = 0; f < points.faces.size(); ++f) {
    const auto corner = [&](std::size_t k) { return Vec3d(points.positions[points.faces[f][k]]); };
    const double area = length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    for (const std::uint32_t p : points.facePoints[f]) areas[p] += area / 3;
  }
  return areas;
}

}  // namespace shbake
