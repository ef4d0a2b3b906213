// Linear maps from light to reflected or shadowed light.
#pragma once

#include <span>
#include <vector>

namespace shbake::sh {

/// The matrix M_ij = integral of b y_i y_j (maths.md (9)): it multiplies light by the function b, such as the
/// visibility of the sky. The light may have a higher order than the output: coefficients up to degree (orderOut - 1) +
/// (orderB - 1) reach the output, so "multiply after projection" equals "multiply before" only for light kept to order
/// orderOut + orderB - 1 (exactOrder()).
class TransferMatrix {
 public:
  /// From the orderB^2 coefficients of b. Throws a usage error when an order is not in 1..GauntTable::kMaxGauntOrder or
  /// `b` is too short.
  TransferMatrix(int orderOut, int orderLight, int orderB, std::span<const double> b);

  /// The order of the light from which on nothing is cut off.
  static constexpr int exactOrder(int orderOut, int orderB) { return orderOut + orderB - 1; }

  int rows() const { return rows_; }        ///< orderOut^2
  int columns() const { return columns_; }  ///< orderLight^2
  double operator()(int row, int column) const { return values_[static_cast<std::size_t>(row) * columns_ + column]; }

  /// out = M light, with columns() and rows() coefficients in different arrays.
  void apply(std::span<const double> light, std::span<double> out) const;

 private:
  int orderOut_, orderLight_, rows_, columns_;
  std::vector<double> values_;  ///< by rows
};

}  // namespace shbake::sh
