// Held-out samples: errors, noise and shares on made truth, where all is known.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/support.h"
#include "bake/surface_fit_choice.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// A square floor of n x n cells with samples spread by area, whose truth is `ofPlace`, with noise of both signs.
class MadeTruth {
 public:
  template <class OfPlace>
  MadeTruth(std::size_t samples, double noise, const OfPlace& ofPlace)
      : points_(pointsOf(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 16, 16))) {
    Progress progress;
    places_ = drawPlaces(points_, areaWeights(points_, points_.faces.size()), samples, 1, progress);
    traced_.sets.resize(2);
    for (std::size_t s = 0; s < places_.size(); ++s) {
      Vec3d at;
      for (std::size_t k = 0; k < 3; ++k)
        at += position(points_.facePoints[places_[s].face][k]) * places_[s].weights[k];
      for (std::size_t set = 0; set < 2; ++set) {
        // Uniform noise of this standard deviation.
        const double error = noise * std::sqrt(12.0) * (hashUnit(9 + set, s) - 0.5);
        traced_.sets[set].push_back(float(ofPlace(at) + error));
      }
      traced_.scale.push_back(1);
    }
  }

  HeldOutSamples held() const { return HeldOutSamples(points_, places_, traced_, 1); }
  const LightingPoints& points() const { return points_; }
  Vec3d position(std::uint32_t p) const { return points_.filePosition(p); }
  template <class OfPoint>
  std::vector<float> values(const OfPoint& ofPoint) const {
    std::vector<float> all;
    for (std::uint32_t p = 0; p < points_.size(); ++p) all.push_back(float(ofPoint(position(p))));
    return all;
  }

 private:
  LightingPoints points_;
  std::vector<SurfacePlace> places_;
  PlaceTransfers traced_;
};

double plane(const Vec3d& at) {
  return 1 + at.x - 0.5 * at.y;
}

}  // namespace

TEST_CASE("held-out samples see an offset through their noise, and tell the noise", "[surface_fit]") {
  const double offset = 0.1, noise = 0.3;
  const MadeTruth made(8192, noise, plane);
  const HeldOutSamples held = made.held();
  const SampledMean error = held.squaredError(made.values([&](const Vec3d& at) { return plane(at) + offset; }));
  CHECK(std::abs(error.mean - offset * offset) < 4 * error.error);
  // The product of two noises has the variance noise^4, the cross terms 2 (offset noise)^2.
  const double expected = std::sqrt((std::pow(noise, 4) + 2 * std::pow(offset * noise, 2)) / 8192);
  CHECK(error.error == Approx(expected).epsilon(4 / std::sqrt(4096.0)));
  // The mean of (a - b)^2 / 2, whose relative variance for two uniform variables is below 2.
  CHECK(held.noise() == Approx(noise * noise).epsilon(4 * std::sqrt(2.0 / 8192)));
}

TEST_CASE("what interpolation adds is told apart from the stated noise of the corners", "[surface_fit]") {
  const double offset = 0.1;
  const float stated = 0.2f;
  const MadeTruth made(8192, 0, plane);
  const HeldOutSamples held = made.held();
  const auto values = made.values([&](const Vec3d& at) { return plane(at) + offset; });
  const std::vector<double> missed = held.missedSquares(values, std::vector<float>(made.points().size(), stated));
  // E[sum of w^2] = 1/2 over a triangle; it is 1/3 to 1.
  CHECK(stratifiedMean(missed).mean ==
        Approx(offset * offset - double{stated} * stated / 2).margin(4 * 0.04 * (2.0 / 3) / std::sqrt(8192.0)));
  CHECK(*std::max_element(missed.begin(), missed.end()) <= offset * offset - 0.04 / 3 + 1e-6);
}

TEST_CASE("the share of a change is the best one", "[surface_fit]") {
  const MadeTruth made(2048, 0, plane);
  const HeldOutSamples held = made.held();
  const std::vector<float> zero = made.values([](const Vec3d&) { return 0; });
  for (const auto& [factor, share] : {std::pair{1.0, 1.0}, {2.0, 0.5}, {0.5, 1.0}, {-1.0, 0.0}}) {
    INFO("change of " << factor << " times the truth");
    const double f = factor;
    const RegionalShares shares = held.chooseShares(zero, made.values([&](const Vec3d& at) { return f * plane(at); }));
    CHECK(shares.begins.front() == 0);
    CHECK(shares.takesAny() == (share > 0));
    for (std::uint32_t p = 0; p < made.points().size(); ++p) {
      CHECK(shares.ofPoint(p) == Approx(share).margin(1e-6));
    }
  }
  CHECK_FALSE(held.chooseShares(zero, zero).takesAny());
}

TEST_CASE("a change that helps one half is not taken in the other", "[surface_fit]") {
  const MadeTruth made(8192, 0.1, plane);
  const std::vector<float> zero = made.values([](const Vec3d&) { return 0; });
  const auto change = made.values([](const Vec3d& at) { return at.y < 0.5 ? 1.0 : -0.5; });
  const RegionalShares shares = made.held().chooseShares(zero, change);
  // Cells of the border between the halves, and the regions that hold them, belong to both.
  std::size_t taken = 0, good = 0, harmed = 0, bad = 0;
  for (std::uint32_t p = 0; p < made.points().size(); ++p) {
    const double y = made.position(p).y;
    if (y < 0.3) ++good, taken += shares.ofPoint(p) > 0.5;
    if (y > 0.7) ++bad, harmed += shares.ofPoint(p) > 0;
  }
  CHECK(taken == good);
  CHECK(harmed == 0);
  CHECK((good > 0 && bad > 0));
}

TEST_CASE("what is noise is not taken", "[surface_fit]") {
  // Changes that have nothing to do with the truth seem to gain by chance. The gain at the best share is n^2 / |d|^2
  // with the standard error 2 n sd(n) / |d|^2: it is significant where n is 3.92 sd(n) or more, in 4.4e-5 of all
  // trials.
  const MadeTruth made(2048, 0.5, [](const Vec3d&) { return 0; });
  const HeldOutSamples held = made.held();
  const std::vector<float> zero = made.values([](const Vec3d&) { return 0; });
  int taken = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::uint64_t i = 0;
    const auto seed = static_cast<std::uint64_t>(100 + trial);
    taken += held.chooseShares(zero, made.values([&](const Vec3d&) { return hashUnit(seed, i++) - 0.5; })).takesAny();
  }
  // Two or more: 4e-5.
  CHECK(taken <= 1);
}
