#include "bake/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <new>
#include <string>

#include "bake/contact_search.h"
#include "bake/face_twins.h"
#include "base/error.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace shbake {
namespace {

/// Rays begin this far from their origin in units of contactDistance(), which spares the filter most faces that touch
/// it.
constexpr double kNear = 0.5;
/// Float hit distances are off by a few ulp of the coordinate scale, contactDistance(); hits that seem farther from
/// contact than this are.
constexpr double kSuspect = 16;
/// Rounding of the product of normal and distance of a face that the origin lies on, in units of its edge length cubed:
/// differences of coordinates carry one half ulp, a cross and a scalar product three each, sqrt(3) times as sums of
/// absolute values. Of slivers, whose normal is short, this is far more than the suspect distance.
constexpr double kProductRounding = 16 * 0x1p-24;

/// What the filter needs beside the ray and the hit.
struct FilterData {
  const Triangle* faces = nullptr;
  const Vec3f* positions = nullptr;
  double contact = 0;  // distance to a plane, in work units
  float suspect2 = 0;  // square of the greater one within which a hit is looked at
  float product = 0;   // error of such a distance times twice a face's area
};

float longestEdge(const LightingPoints& points) {
  float longest2 = 0;
  for (const Triangle& t : points.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f edge = points.positions[t[k]] - points.positions[t[(k + 1) % 3]];
      longest2 = std::max(longest2, dot(edge, edge));
    }
  }
  return std::sqrt(longest2);
}

/// Whether `origin` lies on the plane of a face but for the rounding of coordinates. Exact to double.
bool inContact(const FilterData& data, const Triangle& t, const Vec3f& origin) {
  const Vec3d a(data.positions[t[0]]), b(data.positions[t[1]]), c(data.positions[t[2]]);
  const Vec3d normal = cross(b - a, c - a);
  return std::abs(dot(normal, a - Vec3d(origin))) <= data.contact * length(normal);
}

/// Rejects hits on faces that touch the ray's own position, whose id every ray carries: those that share it, and those
/// that it lies on without sharing it. Both kinds are met near their plane, which most hits are not: these pass without
/// a look at the face, by float arithmetic whose error is nothing beside the bounds.
void leaveOutOwnFaces(const RTCFilterFunctionNArguments* args) {
  const auto& data = *static_cast<const FilterData*>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] != -1) continue;
    const Vec3f normal(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i), RTCHitN_Ng_z(args->hit, n, i));
    const Vec3f direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                          RTCRayN_dir_z(args->ray, n, i));
    const float height = std::abs(dot(normal, direction) * RTCRayN_tfar(args->ray, n, i));
    const float beyond = height - data.product;
    if (beyond > 0 && beyond * beyond > data.suspect2 * dot(normal, normal)) continue;
    const Triangle& t = data.faces[RTCHitN_primID(args->hit, n, i)];
    const unsigned position = RTCRayN_id(args->ray, n, i);
    const bool shared = t[0] == position || t[1] == position || t[2] == position;
    if (shared || inContact(data, t, data.positions[position])) args->valid[i] = 0;
  }
}

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

[[noreturn]] void fail(RTCError code, const char* text) {
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (code == RTC_ERROR_CANCELLED) throw cancelledError();
  throw Error({.cause = std::string("Embree cannot build the scene: ") + text});
}

}  // namespace

struct RayScene::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  const LightingPoints* points = nullptr;
  std::vector<Vec3f> padded;  // a copy of the positions where these have no room behind them
  std::vector<std::uint32_t> twins;
  Contacts contacts;
  FilterData filter;
  float near = 0, far = 0;
  bool packets = false;  // 16-wide packets are native; the stream is faster elsewhere
  RTCError error = RTC_ERROR_NONE;
  std::string errorText;

  ~State() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

class RayScene::Buffers {
 public:
  alignas(64) std::array<RTCRay, kMaxGroups * 16> shadowStream;
  alignas(64) std::array<RTCRayHit, kMaxGroups * 16> hitStream;
  alignas(64) RTCRayHit16 packet;
};

void RayScene::BuffersDeleter::operator()(Buffers* buffers) const {
  delete buffers;
}

RayScene::BuffersPtr RayScene::makeBuffers() const {
  return BuffersPtr(new Buffers);
}

RayScene::RayScene(const LightingPoints& points, float maxDistance, const Parallel& parallel, Progress& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.points = &points;
  const double contact = contactDistance(points);
  // What is hit nearer than this along the ray is nearer than contact in any case.
  s.near = static_cast<float>(kNear * contact);
  s.far = maxDistance;
  // Embree loads positions as four floats, the last one's fourth from behind the array.
  const bool hasRoom = points.positions.capacity() > points.positions.size();
  if (!hasRoom) {
    s.padded.reserve(points.positions.size() + 1);
    s.padded = points.positions;
  }
  const Vec3f* positions = hasRoom ? points.positions.data() : s.padded.data();
  s.filter = {points.faces.data(), positions, contact, static_cast<float>(std::pow(kSuspect * contact, 2)),
              static_cast<float>(kProductRounding * std::pow(static_cast<double>(longestEdge(points)), 3))};

  s.twins = faceTwins(points, progress);

  const FlushDenormals flush;
  s.device = rtcNewDevice(nullptr);
  if (s.device == nullptr) fail(rtcGetDeviceError(nullptr), "no device");
  rtcSetDeviceErrorFunction(
      s.device,
      [](void* user, RTCError code, const char* text) {
        auto* state = static_cast<State*>(user);
        state->error = code;
        state->errorText = text == nullptr ? "" : text;
      },
      &s);
  s.packets = rtcGetDeviceProperty(s.device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;

  RTCGeometry geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0, sizeof(Vec3f),
                             points.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, points.faces.data(), 0,
                             sizeof(Triangle), points.faces.size());
  rtcSetGeometryUserData(geometry, &s.filter);
  rtcSetGeometryOccludedFilterFunction(geometry, leaveOutOwnFaces);
  rtcSetGeometryIntersectFilterFunction(geometry, leaveOutOwnFaces);
  rtcCommitGeometry(geometry);

  s.scene = rtcNewScene(s.device);
  rtcSetSceneBuildQuality(s.scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcAttachGeometry(s.scene, geometry);
  rtcReleaseGeometry(geometry);
  progress.begin("building", 0, "faces");
  rtcSetSceneProgressMonitorFunction(
      s.scene, [](void* user, double) { return static_cast<Progress*>(user)->tryAdvance(0); }, &progress);
  // Joined from our own threads: a device with a number of threads would set a limit for the whole process.
  parallel.forBlocks(1, 1, [&](std::size_t, std::size_t, int) { rtcJoinCommitScene(s.scene); });
  if (s.error != RTC_ERROR_NONE) fail(s.error, s.errorText.c_str());
  progress.end();
  s.contacts = Contacts(points, s.scene, parallel, progress);
}

RayScene::~RayScene() = default;

const Contacts& RayScene::contacts() const {
  return state_->contacts;
}

namespace {

/// Fills entry i of a packet or stream with what all rays of a point share.
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
void forActive(const RayScene::Rays& rays, const Visit& visit) {
  for (int g = 0; g < rays.groups; ++g) {
    const std::size_t first = static_cast<std::size_t>(g) * 16;
    if (rays.active[g] == 0xFFFF) {
      for (std::size_t i = 0; i < 16; ++i) visit(first + i);
      continue;
    }
    for (unsigned bits = rays.active[g]; bits != 0; bits &= bits - 1) {
      visit(first + static_cast<unsigned>(std::countr_zero(bits)));
    }
  }
}

/// Fills a stream with the active rays in order; returns how many there are.
template <class Stream>
unsigned fillStream(Stream& stream, const RayScene::Rays& rays, const Vec3f& origin, float near, float far) {
  const auto quad = [](const Vec3f& v, float w) { return Quad{v.x, v.y, v.z, w}; };
  const Quad x = quad(rays.axisX, 0), y = quad(rays.axisY, 0), z = quad(rays.axisZ, 0);
  const Quad head = quad(origin, near);
  const Quad tail{far, std::bit_cast<float>(~0u), std::bit_cast<float>(rays.position), 0};
  unsigned n = 0;
  forActive(rays, [&](std::size_t k) {
    RTCRay& ray = rayOf(stream[n++]);
    const Quad direction = x * rays.x[k] + y * rays.y[k] + z * rays.z[k];
    std::memcpy(&ray.org_x, &head, sizeof head);
    std::memcpy(&ray.dir_x, &direction, sizeof direction);
    std::memcpy(&ray.tfar, &tail, sizeof tail);
  });
  return n;
}

/// Bit `i` where a ray was found occluded: Embree then sets tfar to -inf.
unsigned occludedBit(const RTCRay& ray, unsigned i) {
  return std::bit_cast<std::uint32_t>(ray.tfar) >> 31 << i;
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
  const State& s = *state_;
  const Vec3f origin = s.points->positions[rays.position];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::fill_n(hit, rays.groups, std::uint16_t(0));
  if (!s.packets) {
    const unsigned n = fillStream(buffers.shadowStream, rays, origin, s.near, s.far);
    rtcOccluded1M(s.scene, &context, buffers.shadowStream.data(), n, sizeof(RTCRay));
    const RTCRay* ray = buffers.shadowStream.data();
    for (int g = 0; g < rays.groups; ++g) {
      unsigned mask = 0;
      if (rays.active[g] == 0xFFFF) {
        for (unsigned i = 0; i < 16; ++i) mask |= occludedBit(*ray++, i);
      } else {
        for (unsigned bits = rays.active[g]; bits != 0; bits &= bits - 1) {
          mask |= occludedBit(*ray++, static_cast<unsigned>(std::countr_zero(bits)));
        }
      }
      hit[g] = static_cast<std::uint16_t>(mask);
    }
    return;
  }
  RTCRay16& r = buffers.packet.ray;
  for (unsigned i = 0; i < 16; ++i) setCommon(r, i, origin, s.near, rays.position);
  for (int g = 0; g < rays.groups; ++g) {
    if (rays.active[g] == 0) continue;
    rays.turn(g, r.dir_x, r.dir_y, r.dir_z);
    std::fill_n(r.tfar, 16, s.far);
    alignas(64) const auto valid = laneFlags(rays.active[g]);
    rtcOccluded16(valid.data(), s.scene, &context, &r);
    for (unsigned i = 0; i < 16; ++i) hit[g] |= static_cast<std::uint16_t>((r.tfar[i] < 0) << i);
  }
}

void RayScene::closest(const Rays& rays, Buffers& buffers, std::uint16_t* hit, std::uint16_t* front, Hit* hits) const {
  const State& s = *state_;
  const Vec3f origin = s.points->positions[rays.position];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::fill_n(hit, rays.groups, std::uint16_t(0));
  std::fill_n(front, rays.groups, std::uint16_t(0));
  const auto take = [&](std::size_t k, unsigned face, float u, float v, float towards) {
    const auto bit = static_cast<std::uint16_t>(1u << (k % 16));
    hit[k / 16] |= bit;
    hits[k] = {face, quantise(u), quantise(v)};
    const bool isTwin = towards > 0 && !s.twins.empty() && s.twins[face] != LightingPoints::kNone;
    if (isTwin) hits[k] = onTwin(s.points->faces, hits[k], s.twins[face]);
    if (towards < 0 || isTwin) front[k / 16] |= bit;
  };
  if (!s.packets) {
    const unsigned n = fillStream(buffers.hitStream, rays, origin, s.near, s.far);
    for (unsigned i = 0; i < n; ++i) buffers.hitStream[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1M(s.scene, &context, buffers.hitStream.data(), n, sizeof(RTCRayHit));
    const RTCRayHit* entry = buffers.hitStream.data();
    forActive(rays, [&](std::size_t k) {
      const auto& [r, h] = *entry++;
      if (h.geomID == RTC_INVALID_GEOMETRY_ID) return;
      take(k, h.primID, h.u, h.v, h.Ng_x * r.dir_x + h.Ng_y * r.dir_y + h.Ng_z * r.dir_z);
    });
    return;
  }
  RTCRay16& r = buffers.packet.ray;
  RTCHit16& h = buffers.packet.hit;
  for (unsigned i = 0; i < 16; ++i) setCommon(r, i, origin, s.near, rays.position);
  for (int g = 0; g < rays.groups; ++g) {
    if (rays.active[g] == 0) continue;
    rays.turn(g, r.dir_x, r.dir_y, r.dir_z);
    std::fill_n(r.tfar, 16, s.far);
    std::fill_n(h.geomID, 16, RTC_INVALID_GEOMETRY_ID);
    alignas(64) const auto valid = laneFlags(rays.active[g]);
    rtcIntersect16(valid.data(), s.scene, &context, &buffers.packet);
    for (unsigned i = 0; i < 16; ++i) {
      if (h.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      take(static_cast<std::size_t>(g) * 16 + i, h.primID[i], h.u[i], h.v[i],
           h.Ng_x[i] * r.dir_x[i] + h.Ng_y[i] * r.dir_y[i] + h.Ng_z[i] * r.dir_z[i]);
    }
  }
}

#ifdef __SSE__
FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
  _mm_setcsr(saved_ | 0x8040);
}
FlushDenormals::~FlushDenormals() {
  _mm_setcsr(saved_);
}
#else
FlushDenormals::FlushDenormals() : saved_(0) {}
FlushDenormals::~FlushDenormals() = default;
#endif

}  // namespace shbake
