// Transfer matrices: Sloan, Kautz and Snyder, "Precomputed Radiance Transfer for Real-Time Rendering in Dynamic,
// Low-Frequency Lighting Environments", SIGGRAPH 2002, from coefficients instead of samples.
#include "sh/transfer_matrix.h"

#include "sh/basis.h"
#include "sh/check.h"
#include "sh/gaunt.h"

namespace shbake::sh {

TransferMatrix::TransferMatrix(int orderOut, int orderLight, int orderB, std::span<const double> b)
    : orderOut_(orderOut), orderLight_(orderLight) {
  const GauntTable table(orderOut, orderLight, orderB);
  requireCoefficients(orderB, b.size(), "the function of a transfer matrix");
  rows_ = coefficientCount(orderOut);
  columns_ = coefficientCount(orderLight);
  values_.resize(static_cast<std::size_t>(rows_) * columns_);
  for (const GauntEntry& e : table.entries()) {
    values_[static_cast<std::size_t>(e.a) * columns_ + e.b] += e.value * b[e.c];
  }
}

void TransferMatrix::apply(std::span<const double> light, std::span<double> out) const {
  requireCoefficients(orderLight_, light.size(), "the light of a transfer matrix");
  requireCoefficients(orderOut_, out.size(), "the output of a transfer matrix");
  const double* value = values_.data();
  for (int row = 0; row < rows_; ++row) {
    double sum = 0;
    for (int column = 0; column < columns_; ++column) sum += *value++ * light[column];
    out[row] = sum;
  }
}

}  // namespace shbake::sh
