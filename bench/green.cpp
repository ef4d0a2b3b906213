#include "green.h"

#include <cmath>
#include <numbers>
#include <span>

#include "bake/ray_scene.h"
#include "base/hash.h"
#include "embree_scene.h"
#include "measure.h"
#include "sh/basis.h"

namespace shbake::bench {

GreenBake bakeLikeGreen(const LightingPoints& points, const std::vector<std::uint32_t>& chosen, int order, int side,
                        std::uint64_t seed) {
  const EmbreeScene embree(points, true);
  const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
  const std::size_t samples = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<Vec3f> directions(samples);
  std::vector<double> table(samples * count);
  for (std::size_t i = 0; i < samples; ++i) {
    const double x = (static_cast<double>(i / side) + hashUnit(seed, 2 * i)) / side;
    const double y = (static_cast<double>(i % side) + hashUnit(seed, 2 * i + 1)) / side;
    const double z = 1 - 2 * x, r = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * std::numbers::pi * y;
    const Vec3d d(r * std::cos(phi), r * std::sin(phi), z);
    directions[i] = Vec3f(d);
    sh::evaluate(order, d, std::span<double>(&table[i * count], count));
  }

  GreenBake result;
  result.transfer.resize(chosen.size() * 3 * count);
  const FlushDenormals flush;
  const double start = cpuSeconds();
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const std::uint32_t p = chosen[c];
    const Vec3f n = points.pointNormal[p], o = points.positions[points.pointPosition[p]];
    const Rgb albedo = points.pointAlbedo[p];
    double* out = &result.transfer[c * 3 * count];
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < samples; ++i) {
      const float h = dot(directions[i], n);
      if (h <= 0) continue;
      result.traced += 1;
      const Vec3f d = directions[i];
      RTCRay ray{o.x, o.y, o.z, embree.nearDistance(), d.x, d.y, d.z, 0, INFINITY, ~0u, points.pointPosition[p], 0};
      rtcOccluded1(embree.scene(), &context, &ray);
      if (ray.tfar < 0) continue;
      for (std::size_t k = 0; k < count; ++k) {
        const double value = static_cast<double>(h) * table[i * count + k];
        out[k] += static_cast<double>(albedo.x) * value;
        out[count + k] += static_cast<double>(albedo.y) * value;
        out[2 * count + k] += static_cast<double>(albedo.z) * value;
      }
    }
    for (std::size_t k = 0; k < 3 * count; ++k) out[k] *= 4 / static_cast<double>(samples);  // (1/pi) * 4 pi / N
  }
  result.cpu = (cpuSeconds() - start) * static_cast<double>(points.size()) / static_cast<double>(chosen.size());
  result.traced /= static_cast<double>(chosen.size());
  return result;
}

}  // namespace shbake::bench
