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

double spinOf(std::uint64_t seed, std::uint32_t point) {
  return 2 * std::numbers::pi * hashUnit(seed, point);
}

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

/// The axes of a point's directions; its fan is ready then.
PointTracer::Axes PointTracer::takeUp(std::uint32_t point) {
  fan_.setPoint(point);
  const sh::LocalFrame frame = sh::localFrame(Vec3d(points_.pointNormal[point]), spin(point));
  return {Vec3f(frame.x), Vec3f(frame.y), Vec3f(frame.z)};
}

/// The rays of some groups of the point that was taken up last, tested against its fan; `at` is where their masks go.
RayScene::Rays PointTracer::testChunk(std::uint32_t point, const Axes& axes, int firstGroup, int groups, std::size_t at,
                                      bool findFaces) {
  const std::size_t ray = static_cast<std::size_t>(firstGroup) * kGroup;
  const RayScene::Rays rays{points_.pointPosition[point],
                            groups,
                            directions_.x() + ray,
                            directions_.y() + ray,
                            directions_.z() + ray,
                            axes.x,
                            axes.y,
                            axes.z,
                            &active_[at]};
  testFan(rays, firstGroup, at, findFaces);
  return rays;
}

void PointTracer::testFan(const RayScene::Rays& rays, int firstGroup, std::size_t at, bool findFaces) {
  for (int g = 0; g < rays.groups; ++g) {
    const std::size_t i = at + static_cast<std::size_t>(g);
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

std::uint16_t PointTracer::skyOf(std::size_t at) const {
  return static_cast<std::uint16_t>(kAll & ~(fanMask_[at] | blocked_[at]));
}

Hit PointTracer::hitOnFan(std::uint32_t face, std::uint32_t position) const {
  const Triangle& t = points_.faces[face];
  const auto whole = [&](std::size_t corner) { return static_cast<std::uint16_t>(t[corner] == position ? 65535 : 0); };
  if (t[0] == position || t[1] == position || t[2] == position) return {face, whole(1), whole(2)};
  const Vec3d weights = weightsAt(points_, face, position);
  const auto part = [](double weight) { return static_cast<std::uint16_t>(weight * 65535 + 0.5); };
  return {face, part(weights.y), part(weights.z)};
}

void PointTracer::traceBatch(std::span<std::uint16_t> sky) {
  scene_.occluded(batch_, *buffers_, blocked_.data());
  for (std::size_t i = 0; i < sky.size(); ++i) sky[i] = skyOf(i);
  batch_.clear();
}

void PointTracer::look(std::uint32_t point, std::span<std::uint16_t> sky) {
  look(std::span(&point, 1), sky);
}

void PointTracer::look(std::span<const std::uint32_t> points, std::span<std::uint16_t> sky) {
  std::size_t done = 0;  // masks
  int together = 0;      // groups of the batch
  const auto trace = [&] {
    traceBatch(sky.subspan(done, static_cast<std::size_t>(together)));
    done += static_cast<std::size_t>(together);
    together = 0;
  };
  for (const std::uint32_t point : points) {
    const Axes axes = takeUp(point);
    for (int first = 0; first < directions_.groups(); first += kChunk) {
      const int groups = std::min(kChunk, directions_.groups() - first);
      if (together + groups > kChunk) trace();
      batch_.push_back(testChunk(point, axes, first, groups, static_cast<std::size_t>(together), false));
      together += groups;
    }
  }
  if (together > 0) trace();
}

void PointTracer::lookForHits(std::uint32_t point, std::span<std::uint16_t> sky, std::vector<Hit>& hits) {
  const Axes axes = takeUp(point);
  for (int first = 0; first < directions_.groups(); first += kChunk) {
    const int groups = std::min(kChunk, directions_.groups() - first);
    const RayScene::Rays rays = testChunk(point, axes, first, groups, 0, true);
    scene_.closest(rays, *buffers_, blocked_.data(), front_.data(), chunkHits_.data());
    for (int g = 0; g < groups; ++g) {
      const auto i = static_cast<std::size_t>(g);
      sky[static_cast<std::size_t>(first + g)] = skyOf(i);
      const unsigned traced = twoSided_ ? blocked_[i] : front_[i];
      for (unsigned bits = traced | fanMask_[i]; bits != 0; bits &= bits - 1) {
        const std::size_t k = i * kGroup + static_cast<unsigned>(std::countr_zero(bits));
        const bool onFan = (fanMask_[i] >> (k % kGroup) & 1) != 0;
        if (onFan && !twoSided_ && !fan_.facesFront(fanFaces_[k])) continue;
        hits.push_back(onFan ? hitOnFan(fanFaces_[k], rays.position) : chunkHits_[k]);
      }
    }
  }
}

}  // namespace shbake
