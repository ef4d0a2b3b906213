// The nearest face by Embree's point queries, which visit the tree's boxes; the faces within are measured here.
#include "chart/sweep/place_finder.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/error.h"

namespace shbake::chart {
namespace {

/// What is looked for, and the best found so far.
struct Search {
  const PointSurface& surface;
  Vec3d position, normal;
  double distance = std::numeric_limits<double>::infinity();
  SurfacePlace place{};

  Vec3d corner(const Triangle& face, std::size_t k) const { return Vec3d(surface.positions[face[k]]); }

  /// Weights of the corners at the foot of the position on the face's plane, with what lies outside the face moved onto
  /// its rim: not always to the nearest place there, but a place within the face is told from all others.
  std::array<double, 3> weightsOn(const Triangle& face) const {
    const Vec3d a = corner(face, 0), b = corner(face, 1), c = corner(face, 2), n = cross(b - a, c - a);
    const double area = dot(n, n);
    if (area <= 0) return {1, 0, 0};
    std::array<double, 3> w{dot(cross(c - b, position - b), n), dot(cross(a - c, position - c), n),
                            dot(cross(b - a, position - a), n)};
    double sum = 0;
    for (double& x : w) sum += x = std::max(0.0, x / area);
    for (double& x : w) x /= sum;
    return w;
  }

  /// Takes the face where it is nearer; true where it was.
  bool offer(std::uint32_t number) {
    const Triangle& face = surface.faces[number];
    const std::array<double, 3> w = weightsOn(face);
    Vec3d at, up;
    for (std::size_t k = 0; k < 3; ++k) {
      at += corner(face, k) * w[k];
      up += Vec3d(surface.normals[face[k]]) * w[k];
    }
    const double away = length(at - position);
    if (away >= distance || dot(up, normal) <= 0) return false;
    distance = away;
    place = {number, w};
    return true;
  }
};

bool offerFace(RTCPointQueryFunctionArguments* args) {
  auto& search = *static_cast<Search*>(args->userPtr);
  if (!search.offer(args->primID)) return false;
  // Boxes that only touch the sphere hold nothing nearer; a little is added for the rounding to float.
  args->query->radius = static_cast<float>(search.distance * (1 + 1e-6));
  return true;
}

}  // namespace

struct PlaceFinder::State {
  const PointSurface& surface;
  std::vector<Vec3f> positions;  // with room behind the last, which Embree reads in whole vectors
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  explicit State(const PointSurface& s) : surface(s), positions(s.positions) {
    positions.emplace_back();
    const RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0, sizeof(Vec3f),
                               surface.positions.size());
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, surface.faces.data(), 0, sizeof(Triangle),
                               surface.faces.size());
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene);
  }
  ~State() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

PlaceFinder::PlaceFinder(const PointSurface& surface) : state_(std::make_unique<State>(surface)) {
  if (rtcGetDeviceError(state_->device) != RTC_ERROR_NONE) {
    throw Error({.cause = "the surface could not be made ready to find places on it", .remedy = "free some memory"});
  }
}

PlaceFinder::~PlaceFinder() = default;

SurfacePlace PlaceFinder::nearest(const Vec3f& position, const Vec3f& normal) const {
  Search search{.surface = state_->surface, .position = Vec3d(position), .normal = Vec3d(normal)};
  RTCPointQuery query{position.x, position.y, position.z, 0, std::numeric_limits<float>::infinity()};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(state_->scene, &query, &context, offerFace, &search);
  if (search.distance == std::numeric_limits<double>::infinity()) {
    throw Error({.cause = "a place of the surface has no face on the refined mesh"});
  }
  return search.place;
}

}  // namespace shbake::chart
