// The product of two functions in coefficients.
#pragma once

#include <span>

#include "sh/gaunt.h"

namespace shbake::sh {

/// Multiplies functions given by coefficients: the coefficients of a * b up to a wanted order (maths.md (8)). Exact for
/// the coefficients that are kept; the whole product has order orderA + orderB - 1. Holds its table, so build it once.
class TripleProduct {
 public:
  /// The orders of the output and of the two factors, 1..GauntTable::kMaxGauntOrder; throws a usage error otherwise.
  TripleProduct(int orderOut, int orderA, int orderB) : table_(orderOut, orderA, orderB) {}

  /// The number of terms of the sum.
  std::size_t terms() const { return table_.entries().size(); }

  /// out = a * b. `out` is another array than a and b. Throws a usage error where sizes do not fit.
  void apply(std::span<const double> a, std::span<const double> b, std::span<double> out) const;

 private:
  GauntTable table_;
};

/// TripleProduct(3, 3, 3) written out, with common factors gathered: 95 multiplications and 74 additions, constants to
/// the last bit. The three arrays hold 9 coefficients each; `out` is another array than a and b.
void multiplyOrder3(std::span<const double, 9> a, std::span<const double, 9> b, std::span<double, 9> out);
void multiplyOrder3(std::span<const float, 9> a, std::span<const float, 9> b, std::span<float, 9> out);

}  // namespace shbake::sh
