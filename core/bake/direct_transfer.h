// Direct light: the part of the transfer that comes straight from the sky.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/direction_set.h"
#include "base/four.h"
#include "sh/local_frame.h"

namespace shbake {

/// What a point sees, and the axes of its directions (sh/local_frame.h).
struct PointView {
  std::span<const std::uint16_t> sky;  ///< a mask for each group of directions
  Vec3d normal;
  double spin;
};

/// Turns visibility masks into transfer vectors. One for each worker thread.
class DirectTransfer {
 public:
  explicit DirectTransfer(const DirectionSet& directions);

  /// The share of the directions that see the sky, 0..1: cosine-weighted visibility.
  double visibility(std::span<const std::uint16_t> sky) const;

  /// The transfer of albedo 1 of a point, order^2 values in world axes:
  ///   t = 1/N sum over visible directions of y(w) + v (exact unshadowed transfer - the lattice's own),
  /// with v the visible share. The second term is a control variate: a point that sees the whole sky is exact. (Weight
  /// 1 instead of v would subtract light that a mostly blocked point never had.)
  void evaluate(const PointView& view, std::span<float> out);
  /// The same of four points, one row after the other in `out`: faster than one by one, with the same result.
  void evaluate(std::span<const PointView, 4> views, std::span<float> out);

 private:
  void sum(std::span<const std::uint16_t> sky);
  void findLocal(std::span<const std::uint16_t> sky);

  const DirectionSet& directions_;
  sh::FrameRotation rotation_;
  std::vector<double> local_, world_;
  std::vector<Four> locals_, worlds_;
};

}  // namespace shbake
