// Dot products of transfer and light (Sloan, Kautz, Snyder, "Precomputed Radiance Transfer", SIGGRAPH 2002, section 4).
#include "view/relight.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"
#include "view/vertex_areas.h"

namespace shbake {
namespace {

constexpr std::size_t kLanes = 8;
/// Points of one block: some ten microseconds of work.
constexpr std::size_t kBlock = 2048;

/// The sum of a[i] b[i]. Eight partial sums let the compiler use vector registers without reordering anything.
inline float dotInLanes(const float* a, const float* b, std::size_t count) {
  std::array<float, kLanes> sum{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) sum[k] += a[i + k] * b[i + k];
  }
  if (i + 4 <= count) {  // order 2 has four coefficients in all
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
    i += 4;
  }
  for (std::size_t k = 0; i < count; ++i, ++k) sum[k] += a[i] * b[i];
  return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

void requireRows(const TransferSet& transfer) {
  const bool shaped = transfer.order >= 1 && (transfer.channels == 1 || transfer.channels == 3);
  if (!shaped || transfer.coefficients.size() % transfer.stride() != 0) {
    throw usageError("the transfer does not hold order^2 coefficients for 1 or 3 channels of each point",
                     "give a transfer that was baked or read from a file");
  }
}

double least(const Rgb& c) {
  return std::min({c.x, c.y, c.z});
}

double greatest(const Rgb& c) {
  return std::max({c.x, c.y, c.z});
}

}  // namespace

Light usedLight(const Light& light, int order, sh::Window window) {
  Light used = withOrder(light, std::min(light.order, order));
  if (window == sh::Window::none) return used;
  std::array<std::vector<double>, 3> channels;
  double lambda = 0;
  for (int c = 0; c < 3; ++c) {
    channels[c] = used.channel(c);
    if (window == sh::Window::automatic) lambda = std::max(lambda, sh::automaticLambda(used.order, channels[c]));
  }
  const std::vector<double> factors = window == sh::Window::automatic ? sh::laplacianFactors(lambda, used.order)
                                                                      : sh::windowFactors(window, used.order);
  for (int c = 0; c < 3; ++c) {
    sh::applyFactors(factors, channels[c]);
    used.setChannel(c, channels[c]);
  }
  return used;
}

std::vector<Rgb> relight(const TransferSet& transfer, const Light& light, const RelightOptions& options,
                         const Parallel& parallel) {
  requireRows(transfer);
  const Light used = usedLight(light, transfer.order, options.window);
  std::array<std::vector<float>, 3> weights;
  for (int c = 0; c < 3; ++c) {
    const std::vector<double> channel = used.channel(c);
    weights[c].assign(channel.begin(), channel.end());
  }
  // Coefficients are ordered by degree: the bands that both share come first in every channel.
  const std::size_t count = weights[0].size();
  const std::size_t channelStep =
      transfer.channels == 3 ? static_cast<std::size_t>(transfer.order) * transfer.order : 0;
  std::vector<Rgb> colors(transfer.size());
  parallel.forBlocks(colors.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t p = begin; p < end; ++p) {
      const float* row = transfer.coefficients.data() + p * transfer.stride();
      Rgb color{dotInLanes(row, weights[0].data(), count), dotInLanes(row + channelStep, weights[1].data(), count),
                dotInLanes(row + 2 * channelStep, weights[2].data(), count)};
      if (options.clampNegative) color = {std::max(color.x, 0.f), std::max(color.y, 0.f), std::max(color.z, 0.f)};
      colors[p] = color;
    }
  });
  return colors;
}

NegativeAudit auditNegatives(const Mesh& mesh, std::span<const Rgb> colors) {
  if (colors.size() != mesh.positions.size()) {
    throw usageError("there are " + std::to_string(colors.size()) + " colours for " +
                     std::to_string(mesh.positions.size()) + " vertices");
  }
  const std::vector<double> areas = vertexAreas(mesh);
  NegativeAudit audit;
  double total = 0, negative = 0, brightest = 0;
  for (std::size_t v = 0; v < colors.size(); ++v) {
    total += areas[v];
    brightest = std::max(brightest, greatest(colors[v]));
    const double low = least(colors[v]);
    if (low < 0) negative += areas[v];
    if (low < audit.worst) {
      audit.worst = low;
      audit.worstVertex = v;
    }
  }
  if (total > 0) audit.areaShare = negative / total;
  if (brightest > 0) audit.worstShare = -audit.worst / brightest;
  return audit;
}

}  // namespace shbake
