// Which directions of a table a lighting point sees: with exact exclusion, or as others leave out what a ray starts
// from.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bake/fan_test.h"
#include "chart/methods/direction_table.h"
#include "chart/methods/method.h"

namespace shbake::chart {

class PointView {
 public:
  virtual ~PointView() = default;
  /// Sets the bits of the directions in which `point` sees the sky, turned by `frame`: one mask a group of the table.
  virtual void look(std::uint32_t point, const DirectionTable& table, const sh::LocalFrame& frame,
                    std::span<std::uint16_t> sky) = 0;
};

/// shbake's own: rays that leave out neighbours and contacts, and the fan test for what these block.
class ExactView : public PointView {
 public:
  explicit ExactView(const TestBed& bed);
  void look(std::uint32_t point, const DirectionTable& table, const sh::LocalFrame& frame,
            std::span<std::uint16_t> sky) override;

 private:
  const LightingPoints& points_;
  const RayScene& scene_;
  FanTest fan_;
  RayScene::BuffersPtr buffers_;
  std::vector<std::uint16_t> active_, blocked_;
};

/// Rays from a place near the point, which begin at a distance; lengths in work units.
struct PlainStart {
  float near = 0;    ///< distance along the ray before which nothing is met
  float offset = 0;  ///< of the origin along the normal
};

/// Rays that avoid what they start from by a distance, or by the scene's filter alone; packets of 16 where these are
/// native, else streams, as ExactView traces.
class PlainView : public PointView {
 public:
  PlainView(const LightingPoints& points, const EmbreeScene& scene, const PlainStart& start);
  void look(std::uint32_t point, const DirectionTable& table, const sh::LocalFrame& frame,
            std::span<std::uint16_t> sky) override;

 private:
  void lookByPackets(const RTCRay& first, const DirectionTable& table, const sh::LocalFrame& frame,
                     std::span<std::uint16_t> sky);
  void lookByStream(const RTCRay& first, const DirectionTable& table, const sh::LocalFrame& frame,
                    std::span<std::uint16_t> sky);

  const LightingPoints& points_;
  const EmbreeScene& scene_;
  PlainStart start_;
  std::vector<RTCRay> stream_;
};

}  // namespace shbake::chart
