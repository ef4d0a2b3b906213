// The bar of equal time: equation (35) of maths.md.
#include "bake/fit_prospect.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace shbake {
namespace {

/// What a fit with as many rays as the bake leaves of the variance of the noise; with F times as many, 1/sqrt(F) of
/// that. 0.33 to 0.85 were measured on spot, room and columns at 16 to 256 rays, where fits take 8 to 1 times as many.
constexpr double kNoiseOfFit = 0.6;
/// How often what looking costs counts: it is lost where it ends with no. Of 60 bakes of room.obj with 64 rays, where a
/// fit gains nothing, 8 went on to a pilot at 2 and 3 at 4; of 60 with 256 rays, where it gains a tenth, 43 and 32.
constexpr double kCaution = 4;

}  // namespace

FitProspect::FitProspect(const LightingPoints& points, std::span<const double> faceWeights,
                         std::span<const float> statedErrors, double fitShare)
    : fitShare_(fitShare) {
  double sum = 0, area = 0;
  for (std::size_t f = 0; f < faceWeights.size(); ++f) {
    if (faceWeights[f] == 0) continue;
    area += faceWeights[f];
    for (const std::uint32_t p : points.facePoints[f]) sum += faceWeights[f] * std::pow(double{statedErrors[p]}, 2);
  }
  // The weights of a corner, by area, have a mean square of 1/6.
  if (area > 0) noise_ = sum / (6 * area);
}

double FitProspect::least(double lookShare) const {
  const double ofFit = std::min(1.0, kNoiseOfFit / std::sqrt(fitShare_));
  const double inTimeOfFit = std::pow(1 + fitShare_, -1.5), inTimeOfBoth = std::pow(1 + fitShare_ + lookShare, -1.5);
  const double lost = ofFit - inTimeOfFit + kCaution * (inTimeOfFit - inTimeOfBoth);
  return noise_ * std::max(0.0, lost) / (1 - kUsuallyLeft * kUsuallyLeft);
}

const char* FitProspect::whyUseless(double missed, double lookShare) const {
  if (std::max(missed, noise_) <= kRounding * kRounding) return "interpolation between the vertices is exact";
  if (missed > least(lookShare)) return nullptr;
  return missed <= noise_ ? "interpolation between the vertices errs less than the noise of the rays"
                          : "interpolation between the vertices errs too little beside the noise of the rays";
}

}  // namespace shbake
