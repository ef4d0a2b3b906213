// Products of functions in coefficients. The idea of a factored form for low orders: Snyder, "Code Generation and
// Factoring for Fast Evaluation of Low-order Spherical Harmonic Products and Squares", Microsoft Research 2006, whose
// constants have ten digits; the factoring and the constants here were derived anew.
#include "sh/triple_product.h"

#include <algorithm>

#include "sh/basis.h"
#include "sh/check.h"

namespace shbake::sh {

void TripleProduct::apply(std::span<const double> a, std::span<const double> b, std::span<double> out) const {
  requireCoefficients(table_.orderA(), out.size(), "the product");
  requireCoefficients(table_.orderB(), a.size(), "the first factor");
  requireCoefficients(table_.orderC(), b.size(), "the second factor");
  std::fill_n(out.begin(), coefficientCount(table_.orderA()), 0.0);
  for (const GauntEntry& e : table_.entries()) out[e.a] += e.value * a[e.b] * b[e.c];
}

namespace {

template <class T>
void multiplyNine(const T* a, const T* b, T* out) {
  constexpr T k0 = T(0.28209479177387814347);     // sqrt(1 / 4 pi)
  constexpr T k112 = T(0.12615662610100800241);   // sqrt(5 / 100 pi)
  constexpr T k112s = T(0.21850968611841581411);  // sqrt(15 / 100 pi)
  constexpr T k222 = T(0.18022375157286857487);   // sqrt(5 / 49 pi)
  constexpr T k222s = T(0.15607834722743986722);  // sqrt(15 / 196 pi)
  constexpr T k222h = T(0.09011187578643428744);  // half of k222
  const auto pair = [&](int i, int j) { return a[i] * b[j] + a[j] * b[i]; };
  const T a0 = k0 * a[0], b0 = k0 * b[0];
  const auto constant = [&](int i) { return a0 * b[i] + b0 * a[i]; };
  T square[9];
  for (int i = 0; i < 9; ++i) square[i] = a[i] * b[i];

  out[0] =
      k0 * (square[0] + square[1] + square[2] + square[3] + square[4] + square[5] + square[6] + square[7] + square[8]);
  out[1] = constant(1) - k112 * pair(1, 6) + k112s * (pair(2, 5) + pair(3, 4) - pair(1, 8));
  out[2] = constant(2) + 2 * k112 * pair(2, 6) + k112s * (pair(1, 5) + pair(3, 7));
  out[3] = constant(3) - k112 * pair(3, 6) + k112s * (pair(1, 4) + pair(2, 7) + pair(3, 8));
  out[4] = constant(4) + k112s * pair(1, 3) - k222 * pair(4, 6) + k222s * pair(5, 7);
  out[5] = constant(5) + k112s * pair(1, 2) + k222h * pair(5, 6) + k222s * (pair(4, 7) - pair(5, 8));
  out[6] = constant(6) + k112 * (square[2] + square[2] - square[1] - square[3]) +
           k222 * (square[6] - square[4] - square[8]) + k222h * (square[5] + square[7]);
  out[7] = constant(7) + k112s * pair(2, 3) + k222h * pair(6, 7) + k222s * (pair(4, 5) + pair(7, 8));
  out[8] = constant(8) + k112s * (square[3] - square[1]) - k222 * pair(6, 8) + k222s * (square[7] - square[5]);
}

}  // namespace

void multiplyOrder3(std::span<const double, 9> a, std::span<const double, 9> b, std::span<double, 9> out) {
  multiplyNine(a.data(), b.data(), out.data());
}

void multiplyOrder3(std::span<const float, 9> a, std::span<const float, 9> b, std::span<float, 9> out) {
  multiplyNine(a.data(), b.data(), out.data());
}

}  // namespace shbake::sh
