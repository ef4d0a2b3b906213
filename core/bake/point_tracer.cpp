#include "bake/point_tracer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>

#include "base/hash.h"
#include "sh/local_frame.h"

namespace shbake {
namespace {

constexpr int kGroup = DirectionSet::kGroup;
constexpr int kChunk = RayScene::kMaxGroups;
constexpr std::uint16_t kAll = 0xFFFF;

}  // namespace

PointTracer::PointTracer(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions,
                         std::uint64_t seed, bool twoSided)
    : points_(points),
      scene_(scene),
      directions_(directions),
      seed_(seed),
      twoSided_(twoSided),
      fan_(points, scene.contacts()),
      buffers_(scene.makeBuffers()),
      fanFaces_(kChunk * kGroup),
      fanMask_(kChunk),
      active_(kChunk),
      blocked_(kChunk),
      front_(kChunk),
      chunkHits_(kChunk * kGroup) {}

double PointTracer::spin(std::uint32_t point) const {
  return 2 * std::numbers::pi * hashUnit(seed_, point);
}

void PointTracer::testFan(const RayScene::Rays& rays, int firstGroup, bool findFaces) {
  for (int g = 0; g < rays.groups; ++g) {
    const auto i = static_cast<std::size_t>(g);
    // Groups above the whole fan need no test, unless their answer is "blocked" and asks for a face.
    const bool above = directions_.lowestZ(firstGroup + g) >= fan_.height() && !fan_.blocksZenith();
    fanMask_[i] = 0;
    if (!above) {
      std::array<float, kGroup> x, y, z;
      rays.turn(g, x.data(), y.data(), z.data());
      fanMask_[i] = static_cast<std::uint16_t>(
          fan_.blocked(x.data(), y.data(), z.data(), findFaces ? &fanFaces_[i * kGroup] : nullptr));
    }
    active_[i] = static_cast<std::uint16_t>(kAll & ~fanMask_[i]);
  }
}

Hit PointTracer::hitOnFan(std::uint32_t face, std::uint32_t position) const {
  const Triangle& t = points_.faces[face];
  const auto whole = [&](std::size_t corner) { return static_cast<std::uint16_t>(t[corner] == position ? 65535 : 0); };
  if (t[0] == position || t[1] == position || t[2] == position) return {face, whole(1), whole(2)};
  const Vec3d weights = weightsAt(points_, face, position);
  const auto part = [](double weight) { return static_cast<std::uint16_t>(weight * 65535 + 0.5); };
  return {face, part(weights.y), part(weights.z)};
}

template <class Trace>
void PointTracer::forChunks(std::uint32_t point, std::span<std::uint16_t> sky, bool findFaces, const Trace& trace) {
  const Vec3d normal(points_.pointNormal[point]);
  const sh::LocalFrame frame = sh::localFrame(normal, spin(point));
  fan_.setPoint(point);
  for (int first = 0; first < directions_.groups(); first += kChunk) {
    const int groups = std::min(kChunk, directions_.groups() - first);
    const std::size_t ray = static_cast<std::size_t>(first) * kGroup;
    const RayScene::Rays rays{points_.pointPosition[point],
                              groups,
                              directions_.x() + ray,
                              directions_.y() + ray,
                              directions_.z() + ray,
                              Vec3f(frame.x),
                              Vec3f(frame.y),
                              Vec3f(frame.z),
                              active_.data()};
    testFan(rays, first, findFaces);
    trace(rays);
    for (int g = 0; g < groups; ++g) {
      const auto i = static_cast<std::size_t>(g);
      sky[static_cast<std::size_t>(first + g)] = static_cast<std::uint16_t>(kAll & ~(fanMask_[i] | blocked_[i]));
    }
  }
}

void PointTracer::look(std::uint32_t point, std::span<std::uint16_t> sky) {
  forChunks(point, sky, false, [&](const RayScene::Rays& rays) { scene_.occluded(rays, *buffers_, blocked_.data()); });
}

void PointTracer::lookForHits(std::uint32_t point, std::span<std::uint16_t> sky, std::vector<Hit>& hits) {
  const std::uint32_t position = points_.pointPosition[point];
  forChunks(point, sky, true, [&](const RayScene::Rays& rays) {
    scene_.closest(rays, *buffers_, blocked_.data(), front_.data(), chunkHits_.data());
    for (int g = 0; g < rays.groups; ++g) {
      const auto i = static_cast<std::size_t>(g);
      const unsigned traced = twoSided_ ? blocked_[i] : front_[i];
      for (unsigned bits = traced | fanMask_[i]; bits != 0; bits &= bits - 1) {
        const std::size_t k = i * kGroup + static_cast<unsigned>(std::countr_zero(bits));
        const bool onFan = (fanMask_[i] >> (k % kGroup) & 1) != 0;
        if (onFan && !twoSided_ && !fan_.facesFront(fanFaces_[k])) continue;
        hits.push_back(onFan ? hitOnFan(fanFaces_[k], position) : chunkHits_[k]);
      }
    }
  });
}

}  // namespace shbake
