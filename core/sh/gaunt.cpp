// Gaunt coefficients of real spherical harmonics. Selection rules: Homeier and Steinborn, "Some properties of the
// coupling coefficients of real spherical harmonics and their relation to Gaunt coefficients", J. Mol. Struct.
// (Theochem) 1996.
#include "sh/gaunt.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "sh/basis.h"
#include "sh/check.h"
#include "sh/quadrature.h"

namespace shbake::sh {
namespace {

/// The factor of the azimuth: the integral over a turn of three functions cos m phi (m >= 0) or sin |m| phi (m < 0), by
/// the product rules of cosines and sines. m1..m3 hold an even number of sines.
double azimuthIntegral(int m1, int m2, int m3) {
  // Bring the sines, if any, to the first two places.
  if (m3 < 0) std::swap(m3, m1 < 0 ? m2 : m1);
  const int a = std::abs(m1), b = std::abs(m2), c = std::abs(m3);
  // Each product of three is a quarter of the sum over cos((+-a +- b + c) phi), two signs of which turn around for
  // sines; a term integrates to 2 pi where its frequency is zero. Both signs of the frequency count once.
  const auto zero = [](int frequency) { return frequency == 0 ? 1 : 0; };
  const int difference = zero(a - b - c) + zero(a - b + c), sum = zero(a + b - c) + zero(a + b + c);
  return std::numbers::pi / 2 * (m1 < 0 ? difference - sum : difference + sum);
}

/// The polar factors of all degrees at the nodes of a rule: values(l, m) are y_lm with cos m phi left out, node by
/// node.
class PolarTable {
 public:
  PolarTable(int order, const IntervalRule& rule)
      : nodes_(rule.nodes.size()), values_(coefficientCount(order) * nodes_) {
    std::vector<double> y(coefficientCount(order));
    for (std::size_t k = 0; k < nodes_; ++k) {
      const double z = rule.nodes[k];
      evaluate(order, Vec3d{std::sqrt((1 - z) * (1 + z)), 0, z}, y);
      for (std::size_t i = 0; i < y.size(); ++i) values_[i * nodes_ + k] = y[i];
    }
  }

  /// Values at all nodes for degree l and |m|.
  const double* operator()(int l, int m) const { return &values_[index(l, std::abs(m)) * nodes_]; }

 private:
  std::size_t nodes_;
  std::vector<double> values_;
};

/// The integral of three polar factors, or zero where it drowns in the rounding of its terms.
double polarIntegral(const std::vector<double>& weights, const double* a, const double* b, const double* c) {
  double sum = 0, magnitude = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double term = weights[k] * a[k] * b[k] * c[k];
    sum += term;
    magnitude += std::abs(term);
  }
  // A true zero beyond the selection rules comes out as a few roundings of the terms.
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * magnitude;
  return std::abs(sum) > rounding ? sum : 0;
}

}  // namespace

GauntTable::GauntTable(int orderA, int orderB, int orderC) : orderA_(orderA), orderB_(orderB), orderC_(orderC) {
  for (const int order : {orderA, orderB, orderC}) requireOrder(order, 1, kMaxGauntOrder, "a product");
  // The three sines of the polar angle multiply to an even power wherever the azimuths do not integrate to zero.
  const IntervalRule rule = gaussLegendre((orderA + orderB + orderC - 3) / 2 + 1);
  const PolarTable polar(std::max({orderA, orderB, orderC}), rule);
  const auto add = [&](int la, int ma, int lb, int mb, int mc) {
    int lc = std::max(std::abs(la - lb), std::abs(mc));
    if ((la + lb + lc) % 2 != 0) ++lc;
    for (; lc <= std::min(la + lb, orderC - 1); lc += 2) {
      const double z = polarIntegral(rule.weights, polar(la, ma), polar(lb, mb), polar(lc, mc));
      if (z == 0) continue;
      entries_.push_back({index(la, ma), index(lb, mb), index(lc, mc), z * azimuthIntegral(ma, mb, mc)});
    }
  };
  for (int a = 0; a < coefficientCount(orderA); ++a) {
    for (int b = 0; b < coefficientCount(orderB); ++b) {
      const int ma = orderOf(a), mb = orderOf(b);
      const int sign = (ma < 0) != (mb < 0) ? -1 : 1;
      const int sum = std::abs(ma) + std::abs(mb), difference = std::abs(std::abs(ma) - std::abs(mb));
      // With an odd number of sines so far the third must be one, and m = 0 is not.
      if (sign > 0 || difference > 0) add(degreeOf(a), ma, degreeOf(b), mb, sign * difference);
      if (sum != difference && (sign > 0 || sum > 0)) add(degreeOf(a), ma, degreeOf(b), mb, sign * sum);
    }
  }
}

}  // namespace shbake::sh
