// What one lighting point sees along all directions of a set: the sky, or faces that reflect.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/direction_set.h"
#include "bake/fan_test.h"
#include "bake/ray_scene.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Looks from lighting points; one for each worker thread. The answer for a point depends on the point, the directions
/// and the seed alone.
class PointTracer {
 public:
  PointTracer(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions, std::uint64_t seed,
              bool twoSided);

  /// The turn of the directions about the point's normal, radians 0..2 pi.
  double spin(std::uint32_t point) const;

  /// Sets the bits of the directions in which the point sees the sky; one mask a group of the set.
  void look(std::uint32_t point, std::span<std::uint16_t> sky);

  /// look() that also appends the hits that reflect towards the point, group by group. A touching face that blocks
  /// (fan_test.h) is a hit at the point's own position.
  void lookForHits(std::uint32_t point, std::span<std::uint16_t> sky, std::vector<Hit>& hits);

 private:
  template <class Trace>
  void forChunks(std::uint32_t point, std::span<std::uint16_t> sky, bool findFaces, const Trace& trace);
  void testFan(const RayScene::Rays& rays, int firstGroup, bool findFaces);
  Hit hitOnFan(std::uint32_t face, std::uint32_t position) const;

  const LightingPoints& points_;
  const RayScene& scene_;
  const DirectionSet& directions_;
  std::uint64_t seed_;
  bool twoSided_;
  FanTest fan_;
  RayScene::BuffersPtr buffers_;
  std::vector<std::uint32_t> fanFaces_;
  std::vector<std::uint16_t> fanMask_, active_, blocked_, front_;
  std::vector<Hit> chunkHits_;
};

}  // namespace shbake
