// Means of paired samples: worked by hand, and intervals that keep their word.
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/sampled_mean.h"
#include "base/hash.h"

using namespace shbake;

TEST_CASE("the mean of pairs and its standard error are those worked by hand", "[sampled_mean]") {
  // Differences 2 and 4 within the pairs: the variance of the mean is (2^2 + 4^2) / 4^2.
  const SampledMean m = stratifiedMean(std::vector<double>{1, 3, 10, 6});
  CHECK(m.mean == 5);
  CHECK(m.error == Approx(std::sqrt(20.0) / 4).epsilon(1e-15));
  CHECK(m.high() - m.mean == Approx(1.959963984540054 * m.error).epsilon(1e-15));
  CHECK(m.mean - m.low() == Approx(1.959963984540054 * m.error).epsilon(1e-15));
  // What differs between the strata is no noise.
  CHECK(stratifiedMean(std::vector<double>{1, 1, 100, 100}).error == 0);
  const SampledMean odd = stratifiedMean(std::vector<double>{1, 3, 5});
  CHECK(odd.mean == 3);
  CHECK(odd.error == Approx(2.0 / 3).epsilon(1e-15));
}

TEST_CASE("the interval holds the mean in 95 of 100 trials", "[sampled_mean]") {
  // Two uniform values in each of 64 strata of different means.
  constexpr int kStrata = 64, kTrials = 4000;
  int held = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values;
    double mean = 0;
    for (std::uint64_t s = 0; s < kStrata; ++s) {
      const double middle = std::sin(static_cast<double>(s));
      mean += middle / kStrata;
      for (std::uint64_t k = 0; k < 2; ++k) values.push_back(middle + hashUnit(trial, 2 * s + k) - 0.5);
    }
    const SampledMean m = stratifiedMean(values);
    held += m.low() <= mean && mean <= m.high();
  }
  // Squared differences of uniform values have 1.4 times their squared mean as variance, so that the stated error is
  // known as that of a normal variable by 91 degrees of freedom: 94.7 % of Student's t lie within 1.96. Four standard
  // errors of a share of 4000 are 1.42 %.
  CHECK(std::abs(held / double{kTrials} - 0.947) < 0.0142);
}

TEST_CASE("the root of a square that noise made negative is none", "[sampled_mean]") {
  const RmsError some = rootOf({4, 0.5});
  CHECK(some.rms == 2);
  CHECK(some.low * some.low == Approx(4 - 0.5 * SampledMean::kConfidence).epsilon(1e-15));
  CHECK(some.high * some.high == Approx(4 + 0.5 * SampledMean::kConfidence).epsilon(1e-15));
  const RmsError none = rootOf({-1, 1});
  CHECK(none.rms == 0);
  CHECK(none.low == 0);
  CHECK(none.high == Approx(std::sqrt(SampledMean::kConfidence - 1)).epsilon(1e-15));
}

TEST_CASE("a surface error says how many samples it has, and where the worst of them is", "[sampled_mean]") {
  const std::vector<double> squares{0.25, -0.5, 9, 1};
  const SurfaceError error = surfaceErrorOf(squares, [](std::size_t i) { return Vec3d(static_cast<double>(i), 2, 3); });
  const RmsError whole = rootOf(stratifiedMean(squares));
  CHECK(error.samples == 4);
  CHECK(error.rays == 0);
  CHECK(error.rms == whole.rms);
  CHECK(error.low == whole.low);
  CHECK(error.high == whole.high);
  CHECK(error.worst == 3);
  CHECK(error.worstPosition == Vec3d(2, 2, 3));
}
