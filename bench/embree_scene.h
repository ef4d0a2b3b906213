// Embree over the faces of lighting points, as bare as can be: what baselines trace with.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "mesh/lighting_points.h"

namespace shbake::bench {

/// A scene of MEDIUM build quality on one thread; `filtered` leaves out faces that touch the ray's position id.
class EmbreeScene {
 public:
  EmbreeScene(const LightingPoints& points, bool filtered);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene scene() const { return scene_; }
  float nearDistance() const { return near_; }
  bool nativePackets() const { return packets_; }

 private:
  std::vector<Vec3f> positions_;
  RTCDevice device_;
  RTCScene scene_;
  float near_ = 0;
  bool packets_;
};

}  // namespace shbake::bench
