// The least and greatest value of a function given by coefficients: the audit for ringing.
#pragma once

#include <span>

#include "base/vec3.h"

namespace shbake::sh {

struct Extreme {
  double value = 0;
  Vec3d direction;  ///< where it is taken, unit length
};

struct Range {
  Extreme min, max;
  /// No value lies below min or above max by more than this: the proven bound of the search grid, 4 % of half the
  /// function's range. The refined values themselves are extremes to 1e-12 of the range.
  double uncertainty = 0;
};

/// The range of the function with these order^2 coefficients: a grid of 8 rings and 16 azimuths an order, then
/// refinement of every grid point that is lowest (highest) among its neighbours and may lie beside the extreme
/// (maths.md (25)). Throws a usage error when order is not in 1..kMaxBasisOrder, or coefficients are missing or not
/// finite.
Range valueRange(int order, std::span<const double> coefficients);

/// Whether no value lies below `floor`: what valueRange() would say, mostly without its refinement.
bool staysAbove(int order, std::span<const double> coefficients, double floor);

}  // namespace shbake::sh
