// Embree over the faces of lighting points: the scene, and the filter that leaves out neighbours.
#include "chart/methods/embree_scene.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace shbake::chart {
namespace {

void leaveOut(const RTCFilterFunctionNArguments* args) {
  const auto* faces = static_cast<const Triangle*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const Triangle& t = faces[RTCHitN_primID(args->hit, args->N, i)];
    const unsigned id = RTCRayN_id(args->ray, args->N, i);
    if (t[0] == id || t[1] == id || t[2] == id) args->valid[i] = 0;
  }
}

}  // namespace

EmbreeScene::EmbreeScene(const LightingPoints& points, bool filtered)
    : positions_(points.positions), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  Vec3f low = positions_[0], high = low;
  for (const Vec3f& p : positions_) {
    near_ = std::max({near_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  near_ *= 8 * FLT_EPSILON;
  diagonal_ = length(high - low);
  positions_.emplace_back();
  packets_ = rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions_.data(), 0, sizeof(Vec3f),
                             points.positions.size());
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, points.faces.data(), 0, sizeof(Triangle),
                             points.faces.size());
  if (filtered) {
    rtcSetGeometryUserData(g, const_cast<Triangle*>(points.faces.data()));
    rtcSetGeometryOccludedFilterFunction(g, leaveOut);
    rtcSetGeometryIntersectFilterFunction(g, leaveOut);
  }
  rtcCommitGeometry(g);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
  rtcAttachGeometry(scene_, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene_);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

}  // namespace shbake::chart
