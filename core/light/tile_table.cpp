// Sums over the cells of a tile, four pairs of opposite cells at a time: the partial sums then stay in registers over
// four products, and rows are as long as vector registers want them.
#include "light/tile_table.h"

#include <algorithm>
#include <cstddef>

#include "light/vector_clones.h"
#include "sh/quadrature.h"

namespace shbake {
namespace {

constexpr int kGroup = 4;

/// The product of the distances to all other nodes: what scales the polynomial of a node to 1 there.
double nodeProduct(const std::vector<double>& nodes, std::size_t which) {
  double product = 1;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    if (j != which) product *= nodes[which] - nodes[j];
  }
  return product;
}

/// The integral over [low, high] of the polynomial that is nodeProduct() in nodes[which] and 0 in the others.
double lagrangeIntegral(const std::vector<double>& nodes, std::size_t which, double low, double high,
                        const sh::IntervalRule& rule) {
  double sum = 0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double x = low + (high - low) * (1 + rule.nodes[k]) / 2;
    double value = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != which) value *= x - nodes[j];
    }
    sum += rule.weights[k] * (high - low) / 2 * value;
  }
  return sum;
}

/// Adds the rows of a group, `columns` apart, times their factors; to nothing at `first`.
SHBAKE_VECTOR_CLONES void addGroup(const double* __restrict rows, const double* factors, int columns, bool first,
                                   double* __restrict sums) {
  const double f0 = factors[0], f1 = factors[1], f2 = factors[2], f3 = factors[3];
  const double* r1 = rows + columns;
  const double* r2 = r1 + columns;
  const double* r3 = r2 + columns;
  if (first) {
    for (int j = 0; j < columns; ++j) sums[j] = (f0 * rows[j] + f1 * r1[j]) + (f2 * r2[j] + f3 * r3[j]);
  } else {
    for (int j = 0; j < columns; ++j) sums[j] += (f0 * rows[j] + f1 * r1[j]) + (f2 * r2[j] + f3 * r3[j]);
  }
}

/// Sum and difference of opposite rows.
SHBAKE_VECTOR_CLONES void fold(const float* __restrict a, const float* __restrict b, int columns,
                               double* __restrict even, double* __restrict odd) {
  for (int j = 0; j < columns; ++j) {
    const double x = static_cast<double>(a[j]), y = static_cast<double>(b[j]);
    even[j] = x + y;
    odd[j] = x - y;
  }
}
SHBAKE_VECTOR_CLONES void fold(const double* __restrict a, const double* __restrict b, int columns,
                               double* __restrict even, double* __restrict odd) {
  for (int j = 0; j < columns; ++j) {
    even[j] = a[j] + b[j];
    odd[j] = a[j] - b[j];
  }
}

}  // namespace

TileTable::TileTable(std::vector<double> nodes, int width) : nodes_(std::move(nodes)), width_(width) {
  const std::size_t n = nodes_.size(), half = (n + 1) / 2;
  const int used = (width + 1) / 2;
  pairs_ = (used + kGroup - 1) / kGroup * kGroup;
  even_.assign(half * pairs_, 0);
  odd_.assign(half * pairs_, 0);
  const sh::IntervalRule exact = sh::gaussLegendre(static_cast<int>(half));
  std::vector<double> products;
  for (std::size_t k = 0; k < n; ++k) products.push_back(nodeProduct(nodes_, k));
  for (int pair = 0; pair < used; ++pair) {
    const double low = -1 + 2.0 * pair / width, high = -1 + 2.0 * (pair + 1) / width;
    for (std::size_t k = 0; k < half; ++k) {
      const double a = lagrangeIntegral(nodes_, k, low, high, exact) / products[k];
      const double b = lagrangeIntegral(nodes_, n - 1 - k, low, high, exact) / products[n - 1 - k];
      even_[k * pairs_ + pair] = (a + b) / 2;
      odd_[k * pairs_ + pair] = (a - b) / 2;
    }
  }
}

void TileTable::addPairs(int firstPair, int columns, Scratch& scratch) const {
  const std::size_t half = (nodes_.size() + 1) / 2;
  for (std::size_t k = 0; k < half; ++k) {
    addGroup(scratch.even.data(), &even_[k * pairs_ + firstPair], columns, firstPair == 0, &scratch.sums[k * columns]);
  }
  for (std::size_t k = 0; k < nodes_.size() / 2; ++k) {
    addGroup(scratch.odd.data(), &odd_[k * pairs_ + firstPair], columns, firstPair == 0,
             &scratch.differences[k * columns]);
  }
}

template <class T>
void TileTable::contract(std::span<const T* const> rows, int columns, std::span<double> out, Scratch& scratch) const {
  const std::size_t n = nodes_.size(), half = (n + 1) / 2, stride = static_cast<std::size_t>(columns);
  scratch.sums.resize(half * stride);
  scratch.differences.resize(half * stride);
  scratch.even.resize(kGroup * stride);
  scratch.odd.resize(kGroup * stride);
  for (int first = 0; first < pairs_; first += kGroup) {
    for (int i = 0; i < kGroup; ++i) {
      const int cell = first + i, opposite = width_ - 1 - cell;
      double *const even = &scratch.even[i * stride], *const odd = &scratch.odd[i * stride];
      if (cell < opposite) {
        fold(rows[cell], rows[opposite], columns, even, odd);
        continue;
      }
      // The middle cell of an odd width is its own opposite; what fills the group up counts nothing.
      std::fill_n(even, columns, 0.0);
      std::fill_n(odd, columns, 0.0);
      if (cell == opposite) std::copy_n(rows[cell], columns, even);
    }
    addPairs(first, columns, scratch);
  }
  for (std::size_t k = 0; k < half; ++k) {
    const double *sums = &scratch.sums[k * stride], *differences = &scratch.differences[k * stride];
    double *low = &out[k * stride], *high = &out[(n - 1 - k) * stride];
    if (k == n - 1 - k) {
      std::copy_n(sums, columns, low);
      continue;
    }
    for (int j = 0; j < columns; ++j) {
      low[j] = sums[j] + differences[j];
      high[j] = sums[j] - differences[j];
    }
  }
}

template void TileTable::contract(std::span<const float* const>, int, std::span<double>, Scratch&) const;
template void TileTable::contract(std::span<const double* const>, int, std::span<double>, Scratch&) const;

}  // namespace shbake
