// What a point sees by rays that avoid their start by a distance.
#include "chart/methods/plain_view.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "bake/ray_scene.h"

namespace shbake::chart {
namespace {

constexpr std::size_t kGroup = DirectionSet::kGroup;
constexpr float kFar = std::numeric_limits<float>::infinity();
/// Rays handed to Embree in one call: as many as shbake's.
constexpr std::size_t kStream = RayScene::kMaxGroups * kGroup;

struct Axes {
  Vec3f x, y, z;

  explicit Axes(const sh::LocalFrame& frame) : x(frame.x), y(frame.y), z(frame.z) {}
  Vec3f turned(const DirectionSet& set, std::size_t i) const {
    return x * set.x()[i] + y * set.y()[i] + z * set.z()[i];
  }
};

}  // namespace

PlainView::PlainView(const LightingPoints& points, const EmbreeScene& scene, const PlainStart& start)
    : points_(points), scene_(scene), start_(start), stream_(scene.nativePackets() ? 0 : kStream) {}

void PlainView::look(std::uint32_t point, const DirectionSet& set, const sh::LocalFrame& frame,
                     std::span<std::uint16_t> sky) {
  const std::uint32_t position = points_.pointPosition[point];
  const Vec3f origin = points_.positions[position] + points_.pointNormal[point] * start_.offset;
  const RTCRay first = rayFrom(origin, start_.near, {}, position);
  scene_.nativePackets() ? lookByPackets(first, set, frame, sky) : lookByStream(first, set, frame, sky);
}

void PlainView::lookByPackets(const RTCRay& first, const DirectionSet& set, const sh::LocalFrame& frame,
                              std::span<std::uint16_t> sky) {
  const Axes axes(frame);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay16 r;
  for (std::size_t k = 0; k < kGroup; ++k) {
    r.org_x[k] = first.org_x, r.org_y[k] = first.org_y, r.org_z[k] = first.org_z;
    r.tnear[k] = first.tnear, r.time[k] = 0, r.mask[k] = first.mask, r.id[k] = first.id, r.flags[k] = 0;
  }
  for (std::size_t g = 0; g < sky.size(); ++g) {
    alignas(64) std::array<int, kGroup> valid;
    for (std::size_t k = 0; k < kGroup; ++k) {
      const Vec3f d = axes.turned(set, g * kGroup + k);
      r.dir_x[k] = d.x, r.dir_y[k] = d.y, r.dir_z[k] = d.z;
      valid[k] = -1;
      r.tfar[k] = kFar;
    }
    rtcOccluded16(valid.data(), scene_.scene(), &context, &r);
    unsigned blocked = 0;
    for (unsigned k = 0; k < kGroup; ++k) blocked |= static_cast<unsigned>(r.tfar[k] < 0) << k;
    sky[g] = static_cast<std::uint16_t>(~blocked);
  }
}

void PlainView::lookByStream(const RTCRay& first, const DirectionSet& set, const sh::LocalFrame& frame,
                             std::span<std::uint16_t> sky) {
  const Axes axes(frame);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const auto n = static_cast<std::size_t>(set.size());
  std::fill(sky.begin(), sky.end(), std::uint16_t(0));
  for (std::size_t begin = 0; begin < n; begin += kStream) {
    const std::size_t count = std::min(kStream, n - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f d = axes.turned(set, begin + i);
      stream_[i] = first;
      stream_[i].dir_x = d.x, stream_[i].dir_y = d.y, stream_[i].dir_z = d.z;
    }
    rtcOccluded1M(scene_.scene(), &context, stream_.data(), static_cast<unsigned>(count), sizeof(RTCRay));
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned seen = std::bit_cast<std::uint32_t>(stream_[i].tfar) >> 31 ^ 1;
      sky[(begin + i) / kGroup] |= static_cast<std::uint16_t>(seen << ((begin + i) % kGroup));
    }
  }
}

}  // namespace shbake::chart
