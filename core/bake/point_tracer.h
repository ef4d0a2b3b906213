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

/// The turn of a point's directions about its normal, radians 0..2 pi.
double spinOf(std::uint64_t seed, std::uint32_t point);

/// Looks from lighting points; one for each worker thread. The answer for a point depends on the point, the directions
/// and the seed alone.
class PointTracer {
 public:
  PointTracer(const LightingPoints& points, const RayScene& scene, const DirectionSet& directions, std::uint64_t seed,
              bool twoSided);

  /// The turn of the directions about the point's normal: spinOf() the tracer's seed.
  double spin(std::uint32_t point) const { return spinOf(seed_, point); }

  /// Sets the bits of the directions in which the point sees the sky; one mask a group of the set.
  void look(std::uint32_t point, std::span<std::uint16_t> sky);

  /// look() for several points, the masks of one after those of the other. Faster than one by one where the directions
  /// are fewer than some hundred and the points are neighbours.
  void look(std::span<const std::uint32_t> points, std::span<std::uint16_t> sky);

  /// look() that also appends the hits that reflect towards the point, group by group. A touching face that blocks
  /// (fan_test.h) is a hit at the point's own position.
  void lookForHits(std::uint32_t point, std::span<std::uint16_t> sky, std::vector<Hit>& hits);

 private:
  /// Where one point's rays go to: its turn and axes.
  struct Axes {
    Vec3f x, y, z;
  };
  Axes takeUp(std::uint32_t point);
  RayScene::Rays testChunk(std::uint32_t point, const Axes& axes, int firstGroup, int groups, std::size_t at,
                           bool findFaces);
  void testFan(const RayScene::Rays& rays, int firstGroup, std::size_t at, bool findFaces);
  void traceBatch(std::span<std::uint16_t> sky);
  std::uint16_t skyOf(std::size_t at) const;
  Hit hitOnFan(std::uint32_t face, std::uint32_t position) const;

  const LightingPoints& points_;
  const RayScene& scene_;
  const DirectionSet& directions_;
  std::uint64_t seed_;
  bool twoSided_;
  FanTest fan_;
  RayScene::BuffersPtr buffers_;
  std::vector<RayScene::Rays> batch_;
  // One entry a group of the batch or chunk that is traced together; of faces and hits, one a direction.
  std::vector<std::uint32_t> fanFaces_;
  std::vector<std::uint16_t> fanMask_, active_, blocked_, front_;
  std::vector<Hit> chunkHits_;
};

}  // namespace shbake
