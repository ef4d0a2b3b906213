#include "bake/stated_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/passes.h"
#include "base/wide.h"
#include "sh/irradiance.h"

namespace shbake {
namespace {

// Variances in units of one cell, as measured by bench_error.
constexpr double kPerPair = 0.055;  // each boundary pair
// Each step between hits, in units of |y|^2: 24 pairs of 16 directions are counted above, but one step a direction
// here.
constexpr double kPerStep = kPerPair * 24 / 16;
constexpr double kBoundary = 0.35;  // once for any boundary: the parts of it too short to show as a pair
constexpr double kFringe = 0.15;    // no boundary here, but at a neighbour
constexpr double kInner = 0.02;     // no boundary here nor at a neighbour, but somewhere on the mesh

double variance(std::uint32_t pairs) {
  return pairs > 0 ? kBoundary + kPerPair * pairs : 0;
}

/// The relative error that one cell amounts to.
double cellError(int rays, int order) {
  return order / std::sqrt(4 * std::numbers::pi) / rays / sh::unshadowedNorm(order);
}

}  // namespace

SHBAKE_WIDE std::uint32_t boundaryPairs(std::span<const std::uint16_t> sky) {
  int pairs = 0;
  for (const unsigned m : sky) {
    // Bit 4 r + c stands at row r, column c of the group's grid: neighbours in a row, then in a column.
    pairs += std::popcount((m ^ (m >> 1)) & 0x7777u) + std::popcount((m ^ (m >> 4)) & 0x0FFFu);
  }
  return static_cast<std::uint32_t>(pairs);
}

std::vector<float> statedErrors(const LightingPoints& points, std::span<const std::uint32_t> pairs,
                                std::span<const float> roughness, int rays, int order, Progress& progress) {
  Passes passes(progress, "stating errors", points.size(), "points", 2);
  std::vector<std::uint8_t> fringe(points.size(), 0);
  passes.forEach(points.facePoints.size(), [&](std::size_t f) {
    const Triangle& t = points.facePoints[f];
    if (pairs[t[0]] == 0 && pairs[t[1]] == 0 && pairs[t[2]] == 0) return;
    for (const std::uint32_t p : t) fringe[p] = 1;
  });
  const bool anyBoundary = std::find(fringe.begin(), fringe.end(), 1) != fringe.end();
  const double inner = anyBoundary ? kInner : 0;
  const double cell = cellError(rays, order);
  std::vector<float> errors(points.size());
  passes.forEach(points.size(), [&](std::size_t p) {
    double v = pairs[p] > 0 ? variance(pairs[p]) : fringe[p] != 0 ? kFringe : inner;
    if (!roughness.empty()) v += kPerStep * static_cast<double>(roughness[p]) * 4 * std::numbers::pi / (order * order);
    errors[p] = static_cast<float>(cell * std::sqrt(v));
  });
  passes.end();
  return errors;
}

double pilotError(std::span<const std::uint32_t> pairs, std::span<const double> weights, int rays, int order) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    sum += weights[i] * variance(pairs[i]);
    weight += weights[i];
  }
  return weight > 0 ? cellError(rays, order) * std::sqrt(sum / weight) : 0;
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
