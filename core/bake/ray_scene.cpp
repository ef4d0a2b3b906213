#include "bake/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "bake/contact_search.h"
#include "bake/own_faces.h"
#include "bake/own_planes.h"

namespace shbake {
namespace {

/// Rays begin this far from their origin in units of the distance within which nothing counts as hit: of
/// contactDistance(), which spares the filter most faces that touch the position, and of the clearance of positions
/// that have one (contact_search.h).
constexpr double kNear = 0.5;

std::uint16_t quantise(float weight) {
  return static_cast<std::uint16_t>(std::clamp(weight, 0.0f, 1.0f) * 65535.0f + 0.5f);
}

/// The same place on a face with the same corners in another order.
Hit onTwin(const std::vector<Triangle>& faces, const Hit& hit, std::uint32_t twin) {
  const Triangle &from = faces[hit.face], &to = faces[twin];
  const auto rest = static_cast<std::uint16_t>(std::max(0, 65535 - hit.u - hit.v));
  const auto weight = [&](std::uint32_t position) {
    return position == from[1] ? hit.u : position == from[2] ? hit.v : rest;
  };
  return {twin, weight(to[1]), weight(to[2])};
}

/// What a filter of Embree gets to know about the call that it is asked for, beginning with Embree's own part.
struct Context {
  RTCIntersectContext embree;
  const OwnFaces* own;
};

/// A bit for each lane of a packet that asks for an answer. Without branches: which lane it is cannot be predicted.
unsigned askingLanes(const int* valid, unsigned count) {
  unsigned lanes = 0;
  for (unsigned i = 0; i < count; ++i) lanes |= static_cast<unsigned>(valid[i] == -1) << i;
  return lanes;
}

/// An intersection filter that rejects hits on faces that touch their ray's position, whose id every ray carries.
void leaveOut(const RTCFilterFunctionNArguments* args) {
  const OwnFaces& own = *reinterpret_cast<const Context*>(args->context)->own;
  const unsigned n = args->N;
  for (unsigned lanes = askingLanes(args->valid, n); lanes != 0; lanes &= lanes - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(lanes));
    const Vec3f normal(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i), RTCHitN_Ng_z(args->hit, n, i));
    const Vec3f direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                          RTCRayN_dir_z(args->ray, n, i));
    const bool touches = own.touches(RTCHitN_primID(args->hit, n, i), RTCRayN_id(args->ray, n, i), normal, direction,
                                     RTCRayN_tfar(args->ray, n, i));
    if (touches) args->valid[i] = 0;
  }
}

/// With leaveOut() or without a filter.
Context contextOf(const OwnFaces& own, bool filtered) {
  Context context{{}, &own};
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = filtered ? leaveOut : nullptr;
  return context;
}

}  // namespace

struct RayScene::State {
  const LightingPoints& points;
  const FaceTree& tree;
  const Contacts& contacts;
  OwnFaces own;
  float near, clearNear;  // where rays begin, the latter those of positions clear of other faces
  float far;
  RTCScene scene;
  bool packets;

  State(const LightingPoints& p, const FaceTree& t, const Contacts& c, float maxDistance)
      : points(p),
        tree(t),
        contacts(c),
        own(p, t.contact(), t.longestEdge()),
        // What is hit nearer than this along the ray is nearer than contact in any case.
        near(static_cast<float>(kNear * t.contact())),
        clearNear(static_cast<float>(kNear * c.clearance())),
        far(maxDistance),
        scene(t.scene()),
        packets(t.hasPackets()) {}
};

/// What a scene has to itself where nobody else has use for it.
struct RayScene::Own {
  FaceTree tree;
  Contacts contacts;

  Own(const LightingPoints& points, const Parallel& parallel, Progress& progress)
      : tree(points, parallel, progress), contacts(points, tree, parallel, progress) {}
};

class RayScene::Buffers {
 public:
  alignas(64) std::array<RTCRay, kMaxGroups * 16> shadowStream;
  alignas(64) std::array<RTCRayHit, kMaxGroups * 16> hitStream;
  alignas(64) RTCRayHit16 packet;
  OwnPlanes planes;
};

void RayScene::BuffersDeleter::operator()(Buffers* buffers) const {
  delete buffers;
}

RayScene::BuffersPtr RayScene::makeBuffers() const {
  return BuffersPtr(new Buffers);
}

RayScene::RayScene(const LightingPoints& points, const FaceTree& tree, const Contacts& contacts, float maxDistance)
    : state_(std::make_unique<State>(points, tree, contacts, maxDistance)) {}

RayScene::RayScene(const LightingPoints& points, float maxDistance, const Parallel& parallel, Progress& progress)
    : own_(std::make_unique<Own>(points, parallel, progress)),
      state_(std::make_unique<State>(points, own_->tree, own_->contacts, maxDistance)) {}

RayScene::~RayScene() = default;

const Contacts& RayScene::contacts() const {
  return state_->contacts;
}

namespace {

/// Fills entry i of a packet with what all rays of a point share.
template <class Packet>
void setCommon(Packet& r, unsigned i, const Vec3f& origin, float near, std::uint32_t position) {
  r.org_x[i] = origin.x;
  r.org_y[i] = origin.y;
  r.org_z[i] = origin.z;
  r.tnear[i] = near;
  r.time[i] = 0;
  r.mask[i] = ~0u;
  r.id[i] = position;
  r.flags[i] = 0;
}

std::array<int, 16> laneFlags(std::uint16_t active) {
  std::array<int, 16> valid;
  for (unsigned i = 0; i < 16; ++i) valid[i] = (active >> i & 1) != 0 ? -1 : 0;
  return valid;
}

RTCRay& rayOf(RTCRay& entry) {
  return entry;
}
RTCRay& rayOf(RTCRayHit& entry) {
  return entry.ray;
}

/// A third of an RTCRay: origin and near distance; direction and time; far distance, mask, id and flags.
using Quad [[gnu::vector_size(16)]] = float;
static_assert(offsetof(RTCRay, dir_x) == sizeof(Quad) && offsetof(RTCRay, tfar) == 2 * sizeof(Quad));

/// Calls visit(k) for every active ray, in order.
template <class Visit>
void forActive(const std::uint16_t* active, int groups, const Visit& visit) {
  for (int g = 0; g < groups; ++g) {
    const std::size_t first = static_cast<std::size_t>(g) * 16;
    if (active[g] == 0xFFFF) {
      for (std::size_t i = 0; i < 16; ++i) visit(first + i);
      continue;
    }
    for (unsigned bits = active[g]; bits != 0; bits &= bits - 1) {
      visit(first + static_cast<unsigned>(std::countr_zero(bits)));
    }
  }
}

/// Writes the active rays in order to `entry` and what follows it; returns the end.
template <class Entry>
Entry* fillStream(Entry* entry, const RayScene::Rays& rays, const std::uint16_t* active, const Vec3f& origin,
                  float near, float far) {
  const auto quad = [](const Vec3f& v, float w) { return Quad{v.x, v.y, v.z, w}; };
  const Quad x = quad(rays.axisX, 0), y = quad(rays.axisY, 0), z = quad(rays.axisZ, 0);
  const Quad head = quad(origin, near);
  const Quad tail{far, std::bit_cast<float>(~0u), std::bit_cast<float>(rays.position), 0};
  const float *localX = rays.x, *localY = rays.y, *localZ = rays.z;  // what is written is none of these
  forActive(active, rays.groups, [&, localX, localY, localZ](std::size_t k) {
    RTCRay& ray = rayOf(*entry++);
    const Quad direction = x * localX[k] + y * localY[k] + z * localZ[k];
    std::memcpy(&ray.org_x, &head, sizeof head);
    std::memcpy(&ray.dir_x, &direction, sizeof direction);
    std::memcpy(&ray.tfar, &tail, sizeof tail);
  });
  return entry;
}

}  // namespace

void RayScene::Rays::turn(int group, float* worldX, float* worldY, float* worldZ) const {
  const std::size_t first = static_cast<std::size_t>(group) * 16;
  for (std::size_t i = 0; i < 16; ++i) {
    const float lx = x[first + i], ly = y[first + i], lz = z[first + i];
    worldX[i] = axisX.x * lx + axisY.x * ly + axisZ.x * lz;
    worldY[i] = axisX.y * lx + axisY.y * ly + axisZ.y * lz;
    worldZ[i] = axisX.z * lx + axisY.z * ly + axisZ.z * lz;
  }
}

void RayScene::occluded(const Rays& rays, Buffers& buffers, std::uint16_t* hit) const {
  occluded(std::span(&rays, 1), buffers, hit);
}

// A filter is called for every face that a ray may meet, which takes up to a third of the time, while next to no ray
// meets a face of its own position. A position that is clear of other faces has no need of it but for rays that run
// along its own; those of them that are blocked are traced again.
void RayScene::occluded(std::span<const Rays> batch, Buffers& buffers, std::uint16_t* hit) const {
  const State& s = *state_;
  Masks open, doubtful, again;
  unsigned anyOpen = 0, anyDoubtful = 0;
  std::size_t g = 0;
  for (const Rays& rays : batch) {
    const bool clear = s.contacts.isClear(rays.position);
    for (int k = 0; k < rays.groups; ++k, ++g) {
      open[g] = clear ? rays.active[k] : 0;
      doubtful[g] = clear ? 0 : rays.active[k];
      anyOpen |= open[g];
      anyDoubtful |= doubtful[g];
    }
  }
  std::fill_n(hit, g, std::uint16_t(0));
  if (anyOpen != 0) {
    traceShadows(batch, open, false, buffers, hit);
    anyDoubtful |= findDoubtful(batch, open, hit, buffers, doubtful);
  }
  if (anyDoubtful == 0) return;
  traceShadows(batch, doubtful, true, buffers, again.data());
  for (std::size_t i = 0; i < g; ++i) hit[i] = static_cast<std::uint16_t>((hit[i] & ~doubtful[i]) | again[i]);
}

unsigned RayScene::findDoubtful(std::span<const Rays> batch, const Masks& open, const std::uint16_t* hit,
                                Buffers& buffers, Masks& doubtful) const {
  const State& s = *state_;
  unsigned any = 0;
  std::size_t g = 0;
  for (const Rays& rays : batch) {
    bool known = false;
    for (int k = 0; k < rays.groups; ++k, ++g) {
      if (open[g] == 0 || hit[g] == 0) continue;
      if (!known) {
        buffers.planes.setPosition(s.points, rays.position, rays.axisX, rays.axisY, rays.axisZ, s.clearNear);
        known = true;
      }
      const std::size_t first = static_cast<std::size_t>(k) * 16;
      doubtful[g] = buffers.planes.close(rays.x + first, rays.y + first, rays.z + first, hit[g]);
      any |= doubtful[g];
    }
  }
  return any;
}

void RayScene::traceShadows(std::span<const Rays> batch, const Masks& active, bool filtered, Buffers& buffers,
                            std::uint16_t* hit) const {
  const State& s = *state_;
  if (s.packets) return tracePackets(batch, active, filtered, buffers, hit);
  const float near = filtered ? s.near : s.clearNear;
  Context context = contextOf(s.own, filtered);
  RTCRay* end = buffers.shadowStream.data();
  std::size_t groups = 0;
  for (const Rays& rays : batch) {
    end = fillStream(end, rays, &active[groups], s.points.positions[rays.position], near, s.far);
    groups += static_cast<std::size_t>(rays.groups);
  }
  const RTCRay* ray = buffers.shadowStream.data();
  rtcOccluded1M(s.scene, &context.embree, buffers.shadowStream.data(), static_cast<unsigned>(end - ray),
                sizeof(RTCRay));
  // Embree sets tfar of what is occluded to -inf.
  const auto occludedBit = [&](unsigned i) { return std::bit_cast<std::uint32_t>(ray++->tfar) >> 31 << i; };
  for (std::size_t g = 0; g < groups; ++g) {
    unsigned mask = 0;
    if (active[g] == 0xFFFF) {
      for (unsigned i = 0; i < 16; ++i) mask |= occludedBit(i);
    } else {
      for (unsigned bits = active[g]; bits != 0; bits &= bits - 1) {
        mask |= occludedBit(static_cast<unsigned>(std::countr_zero(bits)));
      }
    }
    hit[g] = static_cast<std::uint16_t>(mask);
  }
}

void RayScene::tracePackets(std::span<const Rays> batch, const Masks& active, bool filtered, Buffers& buffers,
                            std::uint16_t* hit) const {
  const State& s = *state_;
  const float near = filtered ? s.near : s.clearNear;
  Context context = contextOf(s.own, filtered);
  RTCRay16& r = buffers.packet.ray;
  std::size_t g = 0;
  for (const Rays& rays : batch) {
    const Vec3f origin = s.points.positions[rays.position];
    for (unsigned i = 0; i < 16; ++i) setCommon(r, i, origin, near, rays.position);
    for (int k = 0; k < rays.groups; ++k, ++g) {
      hit[g] = 0;
      if (active[g] == 0) continue;
      rays.turn(k, r.dir_x, r.dir_y, r.dir_z);
      std::fill_n(r.tfar, 16, s.far);
      alignas(64) const auto valid = laneFlags(active[g]);
      rtcOccluded16(valid.data(), s.scene, &context.embree, &r);
      for (unsigned i = 0; i < 16; ++i) hit[g] |= static_cast<std::uint16_t>((r.tfar[i] < 0) << i);
    }
  }
}

void RayScene::closest(const Rays& rays, Buffers& buffers, std::uint16_t* hit, std::uint16_t* front, Hit* hits) const {
  const State& s = *state_;
  const std::vector<std::uint32_t>& twins = s.tree.twins();
  std::fill_n(hit, rays.groups, std::uint16_t(0));
  std::fill_n(front, rays.groups, std::uint16_t(0));
  Masks own{};
  unsigned anyOwn = 0;
  // Where hits on own faces are few, each such ray is traced again with the filter that leaves them out.
  const bool open = s.contacts.isClear(rays.position);
  const auto take = [&](std::size_t k, const Vec3f& direction, float distance, unsigned face, const Vec3f& normal,
                        float u, float v) {
    const auto bit = static_cast<std::uint16_t>(1u << (k % 16));
    if (open && (own[k / 16] & bit) == 0 && s.own.touches(face, rays.position, normal, direction, distance)) {
      own[k / 16] |= bit;
      anyOwn |= bit;
      return;
    }
    hit[k / 16] |= bit;
    hits[k] = {face, quantise(u), quantise(v)};
    const float towards = dot(normal, direction);
    const bool isTwin = towards > 0 && !twins.empty() && twins[face] != LightingPoints::kNone;
    if (isTwin) hits[k] = onTwin(s.points.faces, hits[k], twins[face]);
    if (towards < 0 || isTwin) front[k / 16] |= bit;
  };
  traceHits(rays, rays.active, !open, buffers, take);
  if (anyOwn != 0) traceHits(rays, own.data(), true, buffers, take);
}

template <class Take>
void RayScene::traceHits(const Rays& rays, const std::uint16_t* active, bool filtered, Buffers& buffers,
                         const Take& take) const {
  const State& s = *state_;
  const Vec3f origin = s.points.positions[rays.position];
  Context context = contextOf(s.own, filtered);
  if (!s.packets) {
    RTCRayHit* const begin = buffers.hitStream.data();
    RTCRayHit* const end = fillStream(begin, rays, active, origin, s.near, s.far);
    for (RTCRayHit* entry = begin; entry != end; ++entry) entry->hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1M(s.scene, &context.embree, begin, static_cast<unsigned>(end - begin), sizeof(RTCRayHit));
    const RTCRayHit* entry = begin;
    forActive(active, rays.groups, [&](std::size_t k) {
      const auto& [r, h] = *entry++;
      if (h.geomID == RTC_INVALID_GEOMETRY_ID) return;
      take(k, {r.dir_x, r.dir_y, r.dir_z}, r.tfar, h.primID, {h.Ng_x, h.Ng_y, h.Ng_z}, h.u, h.v);
    });
    return;
  }
  RTCRay16& r = buffers.packet.ray;
  RTCHit16& h = buffers.packet.hit;
  for (unsigned i = 0; i < 16; ++i) setCommon(r, i, origin, s.near, rays.position);
  for (int g = 0; g < rays.groups; ++g) {
    if (active[g] == 0) continue;
    rays.turn(g, r.dir_x, r.dir_y, r.dir_z);
    std::fill_n(r.tfar, 16, s.far);
    std::fill_n(h.geomID, 16, RTC_INVALID_GEOMETRY_ID);
    alignas(64) const auto valid = laneFlags(active[g]);
    rtcIntersect16(valid.data(), s.scene, &context.embree, &buffers.packet);
    for (unsigned i = 0; i < 16; ++i) {
      if (h.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      take(static_cast<std::size_t>(g) * 16 + i, {r.dir_x[i], r.dir_y[i], r.dir_z[i]}, r.tfar[i], h.primID[i],
           {h.Ng_x[i], h.Ng_y[i], h.Ng_z[i]}, h.u[i], h.v[i]);
    }
  }
}

}  // namespace shbake
