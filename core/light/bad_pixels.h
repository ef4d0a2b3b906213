// Pixels of an environment map that cannot be radiance.
#pragma once

#include <cstddef>
#include <span>

#include "base/vec3.h"

namespace shbake {

/// How many pixels were not radiance, and where the first of them is.
struct BadPixels {
  std::size_t nan = 0;       ///< pixels with a NaN in some channel: taken as black
  std::size_t infinite = 0;  ///< pixels with an infinite channel: taken as 65504 from half floats, which hold no more,
                             ///< and as 0 from other formats
  std::size_t negative = 0;  ///< pixels with a channel below 0: that channel is taken as 0, unless negatives are kept
  int x = 0, y = 0;          ///< the first bad pixel, where there is one

  std::size_t total() const { return nan + infinite + negative; }
  /// Joins the counts of later rows.
  void add(const BadPixels& later);
};

/// Counts the bad pixels of row `y` and replaces them by the rules above. Positive infinities become `mostFinite`. A
/// pixel that is bad in several ways counts once: as NaN before infinite before negative.
BadPixels repairRow(std::span<Rgb> row, int y, float mostFinite, bool keepNegative);

}  // namespace shbake
