// A change d of what is interpolated at a sample, taken to the share a, alters the squared error |t - t*|^2 by
// -(2 a n - a^2 |d|^2), n = (t* - t).d, which is linear in the truth t*: noisy rays tell it without bias. The best
// share of a region is sum n / sum |d|^2. Few samples tell it badly, so each region is drawn towards the share of the
// whole by as much as the scatter between regions is explained by the noise within them (DerSimonian, Laird,
// "Meta-analysis in clinical trials", 1986).
#include "bake/surface_fit_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace shbake {
namespace {

/// Samples of a region: enough that the scatter of a share can be told from its noise.
constexpr std::size_t kRegionSamples = 64;

/// What the samples of a region say: n and |d|^2 of above, summed.
struct RegionGain {
  double n = 0, d2 = 0;
  double variance = 0;  // of the share n / d2

  double share() const { return n / d2; }
  double gain(double share) const { return share * (2 * n - share * d2); }
};

/// The shares of regions, drawn towards that of the whole.
std::vector<double> drawTogether(std::span<const RegionGain> regions, double whole) {
  double scatter = 0, weight = 0;
  for (const RegionGain& r : regions) {
    if (r.d2 == 0) continue;
    scatter += r.d2 * (std::pow(r.share() - whole, 2) - r.variance);
    weight += r.d2;
  }
  const double between = std::max(0.0, scatter / weight);
  std::vector<double> shares;
  for (const RegionGain& r : regions) {
    double share = 0;
    if (r.d2 > 0) {
      const double trust = between > 0 ? between / (between + r.variance) : 0;
      share = std::clamp(whole + trust * (r.share() - whole), 0.0, 1.0);
    }
    shares.push_back(r.gain(share) > 0 ? share : 0);
  }
  return shares;
}

}  // namespace

double RegionalShares::ofPoint(std::uint32_t p) const {
  return shares[static_cast<std::size_t>(std::upper_bound(begins.begin(), begins.end(), p) - begins.begin()) - 1];
}

bool RegionalShares::takesAny() const {
  return std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0; });
}

/// What one sample says about a change: n and |d|^2.
struct HeldOutSamples::Gain {
  double n, d2;
};

HeldOutSamples::HeldOutSamples(const LightingPoints& points, std::vector<SurfacePlace> places, PlaceTransfers traced,
                               std::size_t stride)
    : points_(&points), places_(std::move(places)), traced_(std::move(traced)), stride_(stride) {
  const auto lowest = [&](std::size_t s) {
    const Triangle& t = points_->facePoints[places_[s].face];
    return *std::min_element(t.begin(), t.end());
  };
  order_.resize(places_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return lowest(a) < lowest(b); });
  for (std::size_t i = 0; i + kRegionSamples <= order_.size() || i == 0; i += kRegionSamples) {
    const std::uint32_t begin = i == 0 ? 0 : lowest(order_[i]);
    // A large face can have the samples of many regions.
    if (i > 0 && begin == begins_.back()) continue;
    // All samples of a point belong to one region.
    std::size_t cut = i;
    while (cut > 0 && lowest(order_[cut - 1]) == begin) --cut;
    cuts_.push_back(cut);
    begins_.push_back(begin);
  }
  cuts_.push_back(order_.size());
}

void HeldOutSamples::interpolate(std::size_t sample, std::span<const float> coefficients,
                                 std::vector<double>& out) const {
  out.assign(stride_, 0);
  const SurfacePlace& place = places_[sample];
  for (std::size_t k = 0; k < 3; ++k) {
    const float* row = &coefficients[points_->facePoints[place.face][k] * stride_];
    for (std::size_t i = 0; i < stride_; ++i) out[i] += place.weights[k] * static_cast<double>(row[i]);
  }
}

std::vector<double> HeldOutSamples::squares(std::span<const float> coefficients) const {
  std::vector<double> squares(places_.size(), 0), interpolated;
  for (std::size_t s = 0; s < places_.size(); ++s) {
    interpolate(s, coefficients, interpolated);
    const float *one = &traced_.sets[0][s * stride_], *other = &traced_.sets[1][s * stride_];
    for (std::size_t i = 0; i < stride_; ++i) {
      squares[s] += traced_.scale[s] * (interpolated[i] - double{one[i]}) * (interpolated[i] - double{other[i]});
    }
  }
  return squares;
}

SampledMean HeldOutSamples::squaredError(std::span<const float> coefficients) const {
  return stratifiedMean(squares(coefficients));
}

std::vector<double> HeldOutSamples::missedSquares(std::span<const float> coefficients,
                                                  const std::vector<float>& statedErrors) const {
  std::vector<double> missed = squares(coefficients);
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const SurfacePlace& place = places_[s];
    const Triangle& corners = points_->facePoints[place.face];
    for (std::size_t k = 0; k < 3; ++k) missed[s] -= std::pow(place.weights[k] * double{statedErrors[corners[k]]}, 2);
  }
  return missed;
}

double HeldOutSamples::noise() const {
  double sum = 0;
  for (std::size_t s = 0; s < places_.size(); ++s) {
    for (std::size_t i = s * stride_; i < (s + 1) * stride_; ++i) {
      sum += traced_.scale[s] * std::pow(double{traced_.sets[0][i]} - double{traced_.sets[1][i]}, 2) / 2;
    }
  }
  return sum / static_cast<double>(places_.size());
}

HeldOutSamples::Gain HeldOutSamples::gainOf(std::size_t sample, std::span<const float> from,
                                            std::span<const float> to) const {
  std::vector<double> before, after;
  interpolate(sample, from, before);
  interpolate(sample, to, after);
  const float *one = &traced_.sets[0][sample * stride_], *other = &traced_.sets[1][sample * stride_];
  Gain gain{0, 0};
  for (std::size_t i = 0; i < stride_; ++i) {
    const double d = after[i] - before[i], truth = (double{one[i]} + double{other[i]}) / 2;
    gain.n += traced_.scale[sample] * (truth - before[i]) * d;
    gain.d2 += traced_.scale[sample] * d * d;
  }
  return gain;
}

RegionalShares HeldOutSamples::chooseShares(std::span<const float> from, std::span<const float> to) const {
  RegionalShares result{begins_, std::vector<double>(begins_.size(), 0)};
  std::vector<Gain> gains;
  double n = 0, d2 = 0;
  for (std::size_t s = 0; s < places_.size(); ++s) {
    gains.push_back(gainOf(s, from, to));
    n += gains[s].n;
    d2 += gains[s].d2;
  }
  if (n <= 0) return result;
  const double whole = std::min(1.0, n / d2);
  std::vector<double> gained;
  for (const Gain& g : gains) gained.push_back(whole * (2 * g.n - whole * g.d2));
  if (stratifiedMean(gained).low() <= 0) return result;

  std::vector<RegionGain> regions(begins_.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    RegionGain& region = regions[r];
    for (std::size_t i = cuts_[r]; i < cuts_[r + 1]; ++i) {
      region.n += gains[order_[i]].n;
      region.d2 += gains[order_[i]].d2;
    }
    if (region.d2 == 0) continue;
    // That of a ratio of two sums (Cochran, "Sampling Techniques", 3rd ed. 1977, section 6.3).
    for (std::size_t i = cuts_[r]; i < cuts_[r + 1]; ++i) {
      const Gain& g = gains[order_[i]];
      region.variance += std::pow((g.n - region.share() * g.d2) / region.d2, 2);
    }
  }
  result.shares = drawTogether(regions, whole);
  return result;
}

RegionalShares HeldOutSamples::takeUnlessWorse(std::span<const float> from, std::span<const float> to) const {
  double gained = 0;
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const Gain g = gainOf(s, from, to);
    gained += 2 * g.n - g.d2;
  }
  return {{0}, {gained >= 0 ? 1.0 : 0.0}};
}

}  // namespace shbake
