#include "bake/contact_search.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <utility>

namespace shbake {
namespace {

/// Positions in a block of work: half a millisecond of it.
constexpr std::size_t kBlock = 1024;

using Found = std::pair<std::uint32_t, Contact>;

/// Boxes of faces are wider than the clearance by this, since their bounds are rounded to float.
constexpr double kBoxMargin = 1.01;

/// One position's question, handed through Embree to `take`.
struct Query {
  const LightingPoints& points;
  double distance, clearance;
  float margin;  // of boxes
  std::vector<Found>& found;
  std::uint32_t position = 0;
  bool clear = true;

  bool isInBox(const Triangle& t) const {
    const Vec3f &p = points.positions[position], &a = points.positions[t[0]], &b = points.positions[t[1]],
                &c = points.positions[t[2]];
    const auto within = [&](float x, float x0, float x1, float x2) {
      return (x >= std::min({x0, x1, x2}) - margin) & (x <= std::max({x0, x1, x2}) + margin);
    };
    return within(p.x, a.x, b.x, c.x) & within(p.y, a.y, b.y, c.y) & within(p.z, a.z, b.z, c.z);
  }
};

/// Looks at one face that Embree found near; false: the query's radius stays as it is.
bool take(RTCPointQueryFunctionArguments* args) {
  Query& q = *static_cast<Query*>(args->userPtr);
  const Triangle& t = q.points.faces[args->primID];
  if (t[0] == q.position || t[1] == q.position || t[2] == q.position || !q.isInBox(t)) return false;
  if (!mayBeNear(q.points, args->primID, q.position, q.clearance)) return false;
  q.clear = false;
  if (const auto contact = contactOf(q.points, args->primID, q.position, q.distance)) {
    q.found.push_back({q.position, *contact});
  }
  return false;
}

}  // namespace

Contacts::Contacts(const LightingPoints& points, const FaceTree& tree, const Parallel& parallel, Progress& progress)
    : distance_(tree.contact()), clear_(points.positions.size()) {
  search(
      points, tree, clear_.size(), [](std::size_t i) { return static_cast<std::uint32_t>(i); }, parallel, progress);
}

Contacts::Contacts(const LightingPoints& points, const FaceTree& tree, std::span<const std::uint32_t> positions,
                   const Parallel& parallel, Progress& progress)
    : distance_(tree.contact()), clear_(points.positions.size()) {
  search(
      points, tree, positions.size(), [&](std::size_t i) { return positions[i]; }, parallel, progress);
}

template <class PositionAt>
void Contacts::search(const LightingPoints& points, const FaceTree& tree, std::size_t count,
                      const PositionAt& positionAt, const Parallel& parallel, Progress& progress) {
  std::vector<std::vector<Found>> blocks((count + kBlock - 1) / kBlock);
  progress.begin("searching contacts", static_cast<double>(count), "positions");
  parallel.forBlocks(count, kBlock, [&](std::size_t begin, std::size_t end, int) {
    Query query{points, distance_, clearance(), static_cast<float>(kBoxMargin * clearance()), blocks[begin / kBlock]};
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t p = query.position = positionAt(i);
      query.clear = true;
      RTCPointQuery near{points.positions[p].x, points.positions[p].y, points.positions[p].z, 0, query.margin};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      rtcPointQuery(tree.scene(), &near, &context, take, &query);
      clear_[p] = query.clear ? 1 : 0;
    }
    progress.advance(static_cast<double>(end - begin));
  });
  progress.end();
  std::vector<Found> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  std::sort(all.begin(), all.end());
  for (const auto& [position, contact] : all) {
    positions_.push_back(position);
    contacts_.push_back(contact);
  }
}

std::span<const Contact> Contacts::of(std::uint32_t position) const {
  if (contacts_.empty() || isClear(position)) return {};
  const auto [begin, end] = std::equal_range(positions_.begin(), positions_.end(), position);
  return {contacts_.data() + (begin - positions_.begin()), contacts_.data() + (end - positions_.begin())};
}

}  // namespace shbake
