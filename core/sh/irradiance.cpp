// The clamped cosine in spherical harmonics: Ramamoorthi and Hanrahan, "On the relationship between radiance and
// irradiance: determining the illumination from images of a convex Lambertian object", JOSA A 2001.
#include "sh/irradiance.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/check.h"

namespace shbake::sh {

double cosineLobe(int l) {
  using std::numbers::pi;
  if (l < 0) throw usageError("the cosine lobe has no degree " + std::to_string(l), "give a degree of 0 or more");
  if (l == 1) return 2 * pi / 3;
  if (l % 2 != 0) return 0;
  // l! / (2^l (l/2)!^2) as a product that neither overflows nor cancels. A wiki page in circulation prints (l!/2)^2 for
  // (l/2)!^2, which is right at l = 2 alone.
  double central = 1;
  for (int k = 1; k <= l / 2; ++k) central *= (2.0 * k - 1) / (2.0 * k);
  const double sign = l / 2 % 2 == 0 ? -1 : 1;
  return sign * 2 * pi * central / ((l + 2.0) * (l - 1.0));
}

void unshadowedTransfer(int order, const Vec3d& normal, double albedo, std::span<double> out) {
  evaluate(order, normal, out);
  for (int l = 0; l < order; ++l) {
    const double factor = albedo / std::numbers::pi * cosineLobe(l);
    for (int i = index(l, -l); i <= index(l, l); ++i) out[i] *= factor;
  }
}

double unshadowedNorm(int order) {
  requireOrder(order, 1, kMaxBasisOrder, "unshadowed transfer");
  double sum = 0;
  for (int l = 0; l < order; ++l) {
    const double a = cosineLobe(l) / std::numbers::pi;
    sum += a * a * (2 * l + 1) / (4 * std::numbers::pi);
  }
  return std::sqrt(sum);
}

void irradiance(int order, std::span<const double> light, std::span<double> out) {
  requireCoefficients(order, light.size(), "the input of irradiance()");
  requireCoefficients(order, out.size(), "the output of irradiance()");
  for (int l = 0; l < order; ++l) {
    const double factor = cosineLobe(l);
    for (int i = index(l, -l); i <= index(l, l); ++i) out[i] = factor * light[i];
  }
}

double irradianceAt(int order, std::span<const double> light, const Vec3d& normal) {
  requireCoefficients(order, light.size(), "the input of irradianceAt()");
  std::vector<double> transfer(coefficientCount(order));
  // The transfer of a surface with albedo pi: radiance is E then.
  unshadowedTransfer(order, normal, std::numbers::pi, transfer);
  double sum = 0;
  for (std::size_t i = 0; i < transfer.size(); ++i) sum += transfer[i] * light[i];
  return sum;
}

}  // namespace shbake::sh
