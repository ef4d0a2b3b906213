// Irradiance through a cone: the extension of Ramamoorthi and Hanrahan (JOSA A 2001) to an integral that begins at the
// cone's edge instead of the horizon. The cone from ambient occlusion follows from equal irradiance or equal solid
// angle; the rule "half-angle = AO * 90 degrees" agrees with neither but at its ends and one point between.
#include "sh/ao_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"
#include "sh/irradiance.h"
#include "sh/zonal.h"

namespace shbake::sh {
namespace {

void requireShare(double value, const char* what) {
  if (!(value >= 0 && value <= 1)) {
    throw usageError(std::string(what) + " of " + std::to_string(value), "give a value between 0 and 1");
  }
}

/// coneCosineLobe() of degrees 0..degree, from u P_l = ((l+1) P_{l+1} + l P_{l-1}) / (2l+1).
std::vector<double> coneLobes(int degree, double coneCosine) {
  requireShare(coneCosine, "a cone's cosine");
  std::vector<double> lobes(degree + 1);
  const std::vector<double> tails = legendreTails(degree + 1, std::acos(coneCosine));
  for (int l = 0; l <= degree; ++l) {
    const double below = l > 0 ? l * tails[l - 1] : 0;
    lobes[l] = 2 * std::numbers::pi * ((l + 1) * tails[l + 1] + below) / (2 * l + 1);
  }
  return lobes;
}

}  // namespace

double coneCosineLobe(int l, double coneCosine) {
  if (l < 0) throw usageError("the cone's lobe has no degree " + std::to_string(l), "give a degree of 0 or more");
  return coneLobes(l, coneCosine).back();
}

double coneFromCosineVisibility(double visibility) {
  requireShare(visibility, "a visibility");
  return std::sqrt(1 - visibility);
}

double coneFromUniformVisibility(double visibility) {
  requireShare(visibility, "a visibility");
  return 1 - visibility;
}

double coneIrradiance(int order, std::span<const double> light, const Vec3d& normal, double coneCosine) {
  requireCoefficients(order, light.size(), "the light of coneIrradiance()");
  std::vector<double> y(coefficientCount(order));
  evaluate(order, normal, y);
  const std::vector<double> lobes = coneLobes(order - 1, coneCosine);
  double sum = 0;
  for (int i = 0; i < coefficientCount(order); ++i) sum += lobes[degreeOf(i)] * light[i] * y[i];
  return sum;
}

}  // namespace shbake::sh
