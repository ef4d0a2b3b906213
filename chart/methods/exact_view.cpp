// What a point sees by shbake's own rays and fan test, along directions of any table (bake/point_tracer.h does the same
// for its own).
#include <algorithm>
#include <array>

#include "chart/methods/point_view.h"

namespace shbake::chart {
namespace {

constexpr int kGroup = DirectionTable::kGroup;

}  // namespace

ExactView::ExactView(const TestBed& bed)
    : points_(bed.points()),
      scene_(bed.exact()),
      fan_(points_, scene_.contacts()),
      buffers_(scene_.makeBuffers()),
      active_(RayScene::kMaxGroups),
      blocked_(RayScene::kMaxGroups) {}

void ExactView::look(std::uint32_t point, const DirectionTable& table, const sh::LocalFrame& frame,
                     std::span<std::uint16_t> sky) {
  fan_.setPoint(point);
  for (int first = 0; first < table.groups(); first += RayScene::kMaxGroups) {
    const int groups = std::min(RayScene::kMaxGroups, table.groups() - first);
    const std::size_t ray = static_cast<std::size_t>(first) * kGroup;
    const RayScene::Rays rays{points_.pointPosition[point],
                              groups,
                              table.x() + ray,
                              table.y() + ray,
                              table.z() + ray,
                              Vec3f(frame.x),
                              Vec3f(frame.y),
                              Vec3f(frame.z),
                              active_.data()};
    for (int g = 0; g < groups; ++g) {
      unsigned mask = table.activeMask(first + g);
      // Groups above the whole fan need no test.
      if (table.lowestZ(first + g) < fan_.height() || fan_.blocksZenith()) {
        std::array<float, kGroup> x, y, z;
        rays.turn(g, x.data(), y.data(), z.data());
        mask &= ~fan_.blocked(x.data(), y.data(), z.data(), nullptr);
      }
      active_[static_cast<std::size_t>(g)] = static_cast<std::uint16_t>(mask);
    }
    scene_.occluded(rays, *buffers_, blocked_.data());
    for (std::size_t g = 0; g < static_cast<std::size_t>(groups); ++g) {
      sky[static_cast<std::size_t>(first) + g] = static_cast<std::uint16_t>(active_[g] & ~blocked_[g]);
    }
  }
}

}  // namespace shbake::chart
