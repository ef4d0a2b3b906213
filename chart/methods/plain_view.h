// Which directions of a set a lighting point sees by rays that avoid what they start from by a distance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/direction_set.h"
#include "chart/methods/embree_scene.h"
#include "mesh/lighting_points.h"
#include "sh/local_frame.h"

namespace shbake::chart {

/// Rays from a place near the point, which begin at a distance; lengths in work units.
struct PlainStart {
  float near = 0;    ///< distance along the ray before which nothing is met
  float offset = 0;  ///< of the origin along the normal
};

/// Rays that avoid what they start from by a distance, or by the scene's filter alone; packets of 16 where these are
/// native, else streams, as shbake traces.
class PlainView {
 public:
  PlainView(const LightingPoints& points, const EmbreeScene& scene, const PlainStart& start);

  /// Sets the bits of the directions in which `point` sees the sky, turned by `frame`: one mask a group of the set.
  void look(std::uint32_t point, const DirectionSet& set, const sh::LocalFrame& frame, std::span<std::uint16_t> sky);

 private:
  void lookByPackets(const RTCRay& first, const DirectionSet& set, const sh::LocalFrame& frame,
                     std::span<std::uint16_t> sky);
  void lookByStream(const RTCRay& first, const DirectionSet& set, const sh::LocalFrame& frame,
                    std::span<std::uint16_t> sky);

  const LightingPoints& points_;
  const EmbreeScene& scene_;
  PlainStart start_;
  std::vector<RTCRay> stream_;
};

}  // namespace shbake::chart
