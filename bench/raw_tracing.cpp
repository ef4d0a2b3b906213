#include "raw_tracing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bake/flush_denormals.h"
#include "bake/ray_scene.h"
#include "base/hash.h"
#include "chart/methods/cpu_clock.h"
#include "chart/methods/embree_scene.h"
#include "sh/local_frame.h"

namespace shbake::bench {
namespace {

constexpr std::size_t kPoints = 32;  // points prepared at a time, so that their rays stay in the cache
/// The most rays that the bake hands to Embree in one call, of whole points where one has fewer.
constexpr std::size_t kStream = RayScene::kMaxGroups * DirectionSet::kGroup;

struct Axes {
  Vec3f x, y, z;
};

Axes axesOf(const LightingPoints& points, std::size_t p, std::uint64_t seed) {
  const auto frame = sh::localFrame(Vec3d(points.pointNormal[p]), 2 * std::numbers::pi * hashUnit(seed, p));
  return {Vec3f(frame.x), Vec3f(frame.y), Vec3f(frame.z)};
}

}  // namespace

double rawTracing(const LightingPoints& points, const DirectionSet& directions, std::uint64_t seed, bool filtered) {
  const chart::EmbreeScene embree(points, filtered);
  const FlushDenormals flush;
  const auto n = static_cast<std::size_t>(directions.size()), packets = n / 16;
  std::vector<RTCRay> stream(embree.nativePackets() ? 0 : kPoints * n);
  std::vector<RTCRay16> packet(embree.nativePackets() ? kPoints * packets : 0);
  alignas(64) std::array<int, 16> all;
  all.fill(-1);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  double cpu = 0;
  for (std::size_t begin = 0; begin < points.size(); begin += kPoints) {
    const std::size_t count = std::min(kPoints, points.size() - begin);
    for (std::size_t c = 0; c < count; ++c) {
      const Axes a = axesOf(points, begin + c, seed);
      const std::uint32_t position = points.pointPosition[begin + c];
      const Vec3f o = points.positions[position];
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3f d = a.x * directions.x()[i] + a.y * directions.y()[i] + a.z * directions.z()[i];
        if (!embree.nativePackets()) {
          stream[c * n + i] = {o.x, o.y, o.z, embree.nearDistance(), d.x, d.y, d.z, 0, INFINITY, ~0u, position, 0};
          continue;
        }
        RTCRay16& r = packet[c * packets + i / 16];
        const std::size_t k = i % 16;
        r.org_x[k] = o.x, r.org_y[k] = o.y, r.org_z[k] = o.z, r.tnear[k] = embree.nearDistance();
        r.dir_x[k] = d.x, r.dir_y[k] = d.y, r.dir_z[k] = d.z, r.tfar[k] = INFINITY;
        r.time[k] = 0, r.mask[k] = ~0u, r.id[k] = position, r.flags[k] = 0;
      }
    }
    const double start = chart::cpuSeconds();
    for (RTCRay16& r : packet) {
      if (&r - packet.data() >= static_cast<std::ptrdiff_t>(count * packets)) break;
      rtcOccluded16(all.data(), embree.scene(), &context, &r);
    }
    const std::size_t call = n < kStream ? kStream / n * n : kStream;
    for (std::size_t i = 0; i < stream.size() && i < count * n; i += call) {
      const std::size_t some = std::min(call, count * n - i);
      rtcOccluded1M(embree.scene(), &context, &stream[i], static_cast<unsigned>(some), sizeof(RTCRay));
    }
    cpu += chart::cpuSeconds() - start;
  }
  return cpu;
}

}  // namespace shbake::bench
