// Direct transfer: the float table against plain sums in double, and the cases that have a closed form.
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/direct_transfer.h"
#include "bake/support.h"
#include "sh/basis.h"
#include "sh/irradiance.h"
#include "sh/local_frame.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// Masks in which a direction is visible with the given probability.
std::vector<std::uint16_t> randomMasks(const DirectionSet& set, double visible, std::uint64_t seed) {
  std::vector<std::uint16_t> sky(static_cast<std::size_t>(set.groups()), 0);
  for (int i = 0; i < set.size(); ++i) {
    const bool bit = hashUnit(seed, static_cast<std::uint64_t>(i)) < visible;
    sky[static_cast<std::size_t>(i / 16)] |= static_cast<std::uint16_t>(bit << (i % 16));
  }
  return sky;
}

int visibleCount(const std::vector<std::uint16_t>& sky) {
  int count = 0;
  for (const std::uint16_t mask : sky) count += std::popcount(mask);
  return count;
}

/// The estimate's definition, in double and world axes throughout: mean basis over the visible directions, and the
/// closed form less the lattice's mean over all directions, times the visible share.
std::vector<double> plainSum(const DirectionSet& set, const std::vector<std::uint16_t>& sky, const Vec3d& normal,
                             double spin) {
  const auto count = static_cast<std::size_t>(set.order() * set.order());
  const sh::LocalFrame frame = sh::localFrame(normal, spin);
  std::vector<double> visible(count, 0), all(count, 0), exact(count), y(count);
  for (int i = 0; i < set.size(); ++i) {
    const Vec3d d =
        normalized(frame.x * double(set.x()[i]) + frame.y * double(set.y()[i]) + frame.z * double(set.z()[i]));
    sh::evaluate(set.order(), d, y);
    const bool sees = (sky[static_cast<std::size_t>(i / 16)] >> (i % 16) & 1) != 0;
    for (std::size_t k = 0; k < count; ++k) {
      all[k] += y[k] / set.size();
      if (sees) visible[k] += y[k] / set.size();
    }
  }
  sh::unshadowedTransfer(set.order(), normal, 1, exact);
  const double share = double(visibleCount(sky)) / set.size();
  for (std::size_t k = 0; k < count; ++k) visible[k] += share * (exact[k] - all[k]);
  return visible;
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("float tables give the plain double sum at every stride", "[direct_transfer]") {
  // The twin's threshold: 1e-6 of the transfer's norm. Runs of at most 64 groups, 9 additions a group, are summed in
  // float: random roundings of 2^-24 amount to sqrt(576) 2^-24 / sqrt(12), 4e-7 of the terms' size.
  const double threshold = 1e-6;
  for (const int order : {1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 32}) {
    for (const int rays : {16, 256, 2064}) {
      if (order > 9 && rays > 256) continue;
      const DirectionSet set(rays, order);
      DirectTransfer direct(set);
      std::vector<float> out(static_cast<std::size_t>(order * order));
      for (const double visible : {0.05, 0.5, 0.95}) {
        const auto seed = static_cast<std::uint64_t>(order * 1000 + rays);
        const auto sky = randomMasks(set, visible, seed);
        if (visibleCount(sky) == 0) continue;
        const Vec3d normal = randomDirection(seed, 1);
        direct.evaluate({sky, normal, 0.7}, out);
        const std::vector<double> expected = plainSum(set, sky, normal, 0.7);
        std::vector<double> difference(expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) difference[k] = double(out[k]) - expected[k];
        INFO("order " << order << ", rays " << rays << ", visible " << visible);
        CHECK(norm(difference) < threshold * sh::unshadowedNorm(order));
        CHECK(direct.visibility(sky) == double(visibleCount(sky)) / set.size());
      }
    }
  }
}

TEST_CASE("an open point is the closed form exactly, whatever the lattice", "[direct_transfer]") {
  for (const int order : {1, 2, 3, 4, 8, 9, 32}) {
    for (const int rays : {16, 64}) {
      const DirectionSet set(rays, order);
      DirectTransfer direct(set);
      const std::vector<std::uint16_t> sky(static_cast<std::size_t>(set.groups()), 0xFFFF);
      std::vector<float> out(static_cast<std::size_t>(order * order));
      std::vector<double> exact(out.size());
      for (std::uint64_t i = 0; i < 10; ++i) {
        const Vec3d normal = i == 0 ? Vec3d(0, 0, -1) : randomDirection(3, i);
        direct.evaluate({sky, normal, 0.3 * double(i)}, out);
        sh::unshadowedTransfer(order, normal, 1, exact);
        // Rounded to float once; the rotation before it is exact to 1e-14.
        for (std::size_t k = 0; k < out.size(); ++k) {
          REQUIRE(std::abs(double(out[k]) - exact[k]) <= kHalfUlp * std::abs(exact[k]) + 1e-13);
        }
      }
      CHECK(direct.visibility(sky) == 1);
    }
  }
}

TEST_CASE("a buried point gets nothing", "[direct_transfer]") {
  const DirectionSet set(64, 4);
  DirectTransfer direct(set);
  const std::vector<std::uint16_t> sky(4, 0);
  std::vector<float> out(16, 7.0f);
  direct.evaluate({sky, {0, 0.6, 0.8}, 1}, out);
  for (const float value : out) CHECK((value == 0 && !std::signbit(value)));
  CHECK(direct.visibility(sky) == 0);
}

TEST_CASE("four points at once get what each gets alone", "[direct_transfer]") {
  for (const int order : {1, 2, 3, 4, 5, 6, 8, 9, 16}) {
    const DirectionSet set(64, order);
    DirectTransfer direct(set);
    const std::size_t count = static_cast<std::size_t>(order * order);
    std::vector<std::vector<std::uint16_t>> skies;
    for (const double visible : {0.0, 0.3, 0.9, 1.0}) skies.push_back(randomMasks(set, visible, 5));
    std::array<PointView, 4> views;
    for (std::size_t i = 0; i < 4; ++i) {
      // The second normal is the pole.
      const Vec3d normal = i == 1 ? Vec3d(0, 0, -1) : randomDirection(9, i);
      views[i] = {skies[i], normal, 0.5 + double(i)};
    }
    std::vector<float> together(4 * count, 7.0f), alone(count);
    direct.evaluate(views, together);
    for (std::size_t i = 0; i < 4; ++i) {
      INFO("order " << order << ", point " << i);
      direct.evaluate(views[i], alone);
      CHECK(std::equal(alone.begin(), alone.end(), together.begin() + static_cast<std::ptrdiff_t>(i * count)));
    }
    CHECK(visibleCount(skies[3]) == set.size());
  }
}

TEST_CASE("rays add up: two disjoint masks give the sum of their transfers", "[direct_transfer]") {
  const DirectionSet set(256, 4);
  DirectTransfer direct(set);
  const auto some = randomMasks(set, 0.4, 11);
  std::vector<std::uint16_t> others(some.size());
  for (std::size_t g = 0; g < some.size(); ++g) others[g] = static_cast<std::uint16_t>(~some[g]);
  std::vector<float> a(16), b(16);
  std::vector<double> whole(16);
  const Vec3d normal = normalized(Vec3d(1, -2, 3));
  direct.evaluate({some, normal, 2}, a);
  direct.evaluate({others, normal, 2}, b);
  sh::unshadowedTransfer(4, normal, 1, whole);
  for (std::size_t k = 0; k < 16; ++k) {
    // Two sums of 16 groups, 9 additions each at most, of terms whose absolute mean is below 1.
    CHECK(std::abs(double(a[k]) + double(b[k]) - whole[k]) < 2 * 144 * kHalfUlp);
  }
}
