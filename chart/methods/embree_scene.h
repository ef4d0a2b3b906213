// Embree over the faces of lighting points, as bare as can be: what baselines trace with.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "mesh/lighting_points.h"

namespace shbake::chart {

/// A scene of MEDIUM build quality; `filtered` leaves out faces that touch the ray's position id.
class EmbreeScene {
 public:
  EmbreeScene(const LightingPoints& points, bool filtered);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene scene() const { return scene_; }
  /// 8 ulp of the largest coordinate: where rays begin that need not leave anything out by distance.
  float nearDistance() const { return near_; }
  /// The diagonal of the bounding box in work units.
  float diagonal() const { return diagonal_; }
  bool nativePackets() const { return packets_; }

 private:
  std::vector<Vec3f> positions_;
  RTCDevice device_;
  RTCScene scene_;
  float near_ = 0, diagonal_ = 0;
  bool packets_;
};

/// A ray from `origin` that begins at `near`; `position` is what a filtered scene leaves out.
inline RTCRay rayFrom(const Vec3f& origin, float near, const Vec3f& direction, unsigned position) {
  return {origin.x, origin.y, origin.z, near, direction.x, direction.y, direction.z, 0, INFINITY, ~0u, position, 0};
}

/// Whether anything blocks the ray.
inline bool isOccluded(RTCScene scene, RTCRay ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0;
}

/// The same asked by looking for the nearest hit, as programs do that want to know more.
inline bool hasHit(RTCScene scene, const RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit hit{};
  hit.ray = ray;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &hit);
  return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

}  // namespace shbake::chart
