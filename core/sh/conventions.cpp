// Changes of convention. Hazel's basis has its own file, hazel.h.
#include "sh/conventions.h"

#include <algorithm>
#include <vector>

#include "sh/basis.h"
#include "sh/check.h"
#include "sh/quarter_turn.h"

namespace shbake::sh {
namespace {

constexpr double kRootOfSphere = 3.54490770181103205460;  // sqrt(4 pi)

void scale(int order, std::span<double> coefficients, double factor) {
  requireCoefficients(order, coefficients.size(), "the input of a conversion");
  for (double& c : coefficients.first(coefficientCount(order))) c *= factor;
}

template <class Turn>
void turnBands(int order, std::span<double> coefficients, Turn turn) {
  const QuarterTurn quarter(order);
  requireCoefficients(order, coefficients.size(), "the input of a conversion");
  std::vector<double> band(2 * order - 1);
  for (int l = 0; l < order; ++l) {
    turn(quarter, l, &coefficients[index(l, -l)], band.data());
    std::copy_n(band.data(), 2 * l + 1, &coefficients[index(l, -l)]);
  }
}

}  // namespace

void flipCondonShortley(int order, std::span<double> coefficients) {
  requireCoefficients(order, coefficients.size(), "the input of a conversion");
  for (int i = 0; i < coefficientCount(order); ++i) {
    if (orderOf(i) % 2 != 0) coefficients[i] = -coefficients[i];
  }
}

void toGeodesy(int order, std::span<double> coefficients) {
  scale(order, coefficients, 1 / kRootOfSphere);
}

void fromGeodesy(int order, std::span<double> coefficients) {
  scale(order, coefficients, kRootOfSphere);
}

void toYUp(int order, std::span<double> coefficients) {
  turnBands(order, coefficients,
            [](const QuarterTurn& q, int l, const double* in, double* out) { q.applyInverse(l, in, out); });
}

void fromYUp(int order, std::span<double> coefficients) {
  turnBands(order, coefficients,
            [](const QuarterTurn& q, int l, const double* in, double* out) { q.apply(l, in, out); });
}

}  // namespace shbake::sh
