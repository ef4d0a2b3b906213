// The rotations by +-90 degrees about x, and any rotation as Z X Z X Z by means of them.
#pragma once

#include <cstddef>
#include <vector>

#include "base/four.h"
#include "sh/z_rotation.h"

namespace shbake::sh {

/// The band matrices of R_x(+90 degrees), generated to double precision at any degree. Three quarters of their entries
/// are zero by symmetry and are not stored. Immutable, so it may be shared between threads; rotating allocates nothing.
class QuarterTurn {
 public:
  /// Bands 0..order-1. Throws a usage error unless 1 <= order <= kMaxTurnOrder.
  explicit QuarterTurn(int order);

  int order() const { return order_; }

  /// out = R_x(+90) in, for the 2l+1 coefficients m = -l..l of band l < order(). `in` and `out` do not overlap.
  void apply(int l, const double* in, double* out) const;
  /// out = R_x(-90) in.
  void applyInverse(int l, const double* in, double* out) const;

  /// out = R_z(last) R_y(middle) R_z(first) in, for all order()^2 coefficients, where R_y(b) = R_x(-90) R_z(b) R_x(90)
  /// (maths.md (16)). `in` and `out` may be the same array.
  void rotateZyz(Turn last, Turn middle, Turn first, const double* in, double* out) const;
  /// The same of four functions at once, each by angles of its own: the same bits, sooner.
  void rotateZyz(const TurnOf<Four>& last, const TurnOf<Four>& middle, const TurnOf<Four>& first, const Four* in,
                 Four* out) const;

 private:
  struct Bands;
  Bands bands() const;

  int order_;
  std::vector<std::size_t> starts_;         ///< where band l begins in the arrays below
  std::vector<double> forward_, backward_;  ///< the entries that symmetry leaves, row by row, |column order| rising
};

}  // namespace shbake::sh
