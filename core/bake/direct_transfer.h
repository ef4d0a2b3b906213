// Direct light: the part of the transfer that comes straight from the sky.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/direction_set.h"
#include "sh/local_frame.h"

namespace shbake {

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
  void evaluate(std::span<const std::uint16_t> sky, const Vec3d& normal, double spin, std::span<float> out);

 private:
  void sum(std::span<const std::uint16_t> sky);

  const DirectionSet& directions_;
  sh::FrameRotation rotation_;
  std::vector<double> local_, world_;
};

}  // namespace shbake
