#include "bake/point_tracer.h"

#include <algorithm>
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
      fan_(points),
      buffers_(scene.makeBuffers()),
      x_(kChunk * kGroup),
      y_(kChunk * kGroup),
      z_(kChunk * kGroup),
      fanFaces_(kChunk * kGroup),
      fanMask_(kChunk),
      active_(kChunk),
      blocked_(kChunk),
      front_(kChunk),
      chunkHits_(kChunk * kGroup) {}

double PointTracer::spin(std::uint32_t point) const {
  return 2 * std::numbers::pi * hashUnit(seed_, point);
}

void PointTracer::turnDirections(int firstGroup, int groups) {
  const std::size_t first = static_cast<std::size_t>(firstGroup) * kGroup,
                    n = static_cast<std::size_t>(groups) * kGroup;
  const float *lx = directions_.x() + first, *ly = directions_.y() + first, *lz = directions_.z() + first;
  float *x = x_.data(), *y = y_.data(), *z = z_.data();
  const Vec3f a = axisX_, b = axisY_, c = axisZ_;
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = a.x * lx[i] + b.x * ly[i] + c.x * lz[i];
    y[i] = a.y * lx[i] + b.y * ly[i] + c.y * lz[i];
    z[i] = a.z * lx[i] + b.z * ly[i] + c.z * lz[i];
  }
}

void PointTracer::testFan(int firstGroup, int groups) {
  for (int g = 0; g < groups; ++g) {
    const auto i = static_cast<std::size_t>(g);
    // Groups above the whole fan need no test, unless their answer is "blocked" and asks for a face.
    const bool above = directions_.lowestZ(firstGroup + g) >= fan_.height() && !fan_.blocksZenith();
    const std::size_t k = i * kGroup;
    fanMask_[i] =
        above ? std::uint16_t(0) : static_cast<std::uint16_t>(fan_.blocked(&x_[k], &y_[k], &z_[k], &fanFaces_[k]));
    active_[i] = static_cast<std::uint16_t>(kAll & ~fanMask_[i]);
  }
}

Hit PointTracer::hitOnFan(std::uint32_t face, std::uint32_t position) const {
  const Triangle& t = points_.faces[face];
  const auto weight = [&](std::size_t corner) { return static_cast<std::uint16_t>(t[corner] == position ? 65535 : 0); };
  return {face, weight(1), weight(2)};
}

template <class Trace>
void PointTracer::forChunks(std::uint32_t point, std::span<std::uint16_t> sky, const Trace& trace) {
  const Vec3d normal(points_.pointNormal[point]);
  const sh::LocalFrame frame = sh::localFrame(normal, spin(point));
  axisX_ = Vec3f(frame.x);
  axisY_ = Vec3f(frame.y);
  axisZ_ = Vec3f(frame.z);
  fan_.setPoint(point);
  for (int first = 0; first < directions_.groups(); first += kChunk) {
    const int groups = std::min(kChunk, directions_.groups() - first);
    turnDirections(first, groups);
    testFan(first, groups);
    trace(RayScene::Rays{points_.pointPosition[point], groups, x_.data(), y_.data(), z_.data(), active_.data()});
    for (int g = 0; g < groups; ++g) {
      const auto i = static_cast<std::size_t>(g);
      sky[static_cast<std::size_t>(first + g)] = static_cast<std::uint16_t>(kAll & ~(fanMask_[i] | blocked_[i]));
    }
  }
}

void PointTracer::look(std::uint32_t point, std::span<std::uint16_t> sky) {
  forChunks(point, sky, [&](const RayScene::Rays& rays) { scene_.occluded(rays, *buffers_, blocked_.data()); });
}

void PointTracer::lookForHits(std::uint32_t point, std::span<std::uint16_t> sky, std::vector<Hit>& hits) {
  const std::uint32_t position = points_.pointPosition[point];
  forChunks(point, sky, [&](const RayScene::Rays& rays) {
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
