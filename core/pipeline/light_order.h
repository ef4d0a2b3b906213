// How many bands of spherical harmonics pictures under a given light need.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/bake_options.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "light/light.h"

namespace shbake {

struct LightOrder {
  static constexpr int kMost = 8;  ///< the highest order judged

  int order = kMost;
  /// left[n - 1]: what pictures lack that are made with n bands, RMS over points and turns of the light, relative to
  /// pictures made with kMost. The last is 0.
  std::array<double, kMost> left{};
};

/// The least order at which no more than `tolerance` is lacking. Bands of the transfer are measured by tracing some
/// hundred of the wanted points (all where `wanted` is empty), without reflections, which blur: their share in higher
/// bands is smaller. Turned in all ways, band l of the light meets band l of the transfer with a mean square of
/// |L_l|^2 |t_l|^2 / (2l + 1) (maths.md (32)). `light` should have kMost bands or more; a black one gives order 1.
LightOrder chooseOrder(TracedPoints& traced, const std::vector<std::uint8_t>& wanted, const BakeOptions& options,
                       const Light& light, double tolerance, const Parallel& parallel, Progress& progress);

}  // namespace shbake
