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

/// A light as rows of floats, ready to meet those of a transfer.
class LightRows {
 public:
  LightRows(const Light& used, const TransferSet& transfer)
      : channelStep_(transfer.channels == 3 ? static_cast<std::size_t>(transfer.order) * transfer.order : 0) {
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> channel = used.channel(c);
      rows_[c].assign(channel.begin(), channel.end());
    }
  }

  /// Of one point. Coefficients are ordered by degree: the bands that both share come first in every channel.
  Rgb radiance(const TransferSet& transfer, std::size_t point) const {
    const float* t = transfer.coefficients.data() + point * transfer.stride();
    const std::size_t count = rows_[0].size();
    return {dotInLanes(t, rows_[0].data(), count), dotInLanes(t + channelStep_, rows_[1].data(), count),
            dotInLanes(t + 2 * channelStep_, rows_[2].data(), count)};
  }

 private:
  std::array<std::vector<float>, 3> rows_;
  std::size_t channelStep_;
};

Rgb clamped(const Rgb& c) {
  return {std::max(c.x, 0.f), std::max(c.y, 0.f), std::max(c.z, 0.f)};
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
  applyWindow(window, {&used, 1});
  return used;
}

std::vector<Rgb> relight(const TransferSet& transfer, const Light& light, const RelightOptions& options,
                         const Parallel& parallel) {
  requireRows(transfer);
  const LightRows rows(usedLight(light, transfer.order, options.window), transfer);
  std::vector<Rgb> colors(transfer.size());
  parallel.forBlocks(colors.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t p = begin; p < end; ++p) {
      const Rgb color = rows.radiance(transfer, p);
      colors[p] = options.clampNegative ? clamped(color) : color;
    }
  });
  return colors;
}

std::vector<Rgb> relight(const TransferSet& transfer, std::span<const Vec3d> places, const LightRig& rig,
                         const RelightOptions& options, const Parallel& parallel) {
  requireRows(transfer);
  if (places.size() != transfer.size()) {
    throw usageError("there are " + std::to_string(places.size()) + " places for " + std::to_string(transfer.size()) +
                     " points");
  }
  std::vector<Light> lights;
  for (const LightSample& s : rig.samples())
    lights.push_back(withOrder(s.light, std::min(s.light.order, transfer.order)));
  applyWindow(options.window, lights);
  std::vector<LightRows> rows;
  for (const Light& light : lights) rows.emplace_back(light, transfer);
  std::vector<Rgb> colors(transfer.size());
  parallel.forBlocks(colors.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t p = begin; p < end; ++p) {
      Rgb color;
      for (const RigWeight& w : rig.weights(places[p])) {
        color += rows[w.index].radiance(transfer, p) * static_cast<float>(w.weight);
      }
      colors[p] = options.clampNegative ? clamped(color) : color;
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
