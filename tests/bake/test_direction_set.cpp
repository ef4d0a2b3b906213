// Direction sets: the lattice's exact facts, its convergence within bounds that hold for it, and its layout.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "bake/direction_set.h"
#include "bake/support.h"
#include "sh/basis.h"
#include "sh/irradiance.h"
#include "sh/quadrature.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

Vec3d direction(const DirectionSet& set, int i) {
  return {double(set.x()[i]), double(set.y()[i]), double(set.z()[i])};
}

/// Directions by rising distance from the axis: the lattice's own order.
std::vector<int> latticeOrder(const DirectionSet& set) {
  std::vector<int> order(static_cast<std::size_t>(set.size()));
  for (int i = 0; i < set.size(); ++i) order[static_cast<std::size_t>(i)] = i;
  std::sort(order.begin(), order.end(), [&](int a, int b) { return set.z()[a] > set.z()[b]; });
  return order;
}

/// Total variation over 0..1 of a function with few turns, sampled finely.
double variation(const std::function<double(double)>& f) {
  double sum = 0, last = f(0);
  for (int i = 1; i <= 20000; ++i) {
    const double next = f(i / 20000.0);
    sum += std::abs(next - last);
    last = next;
  }
  return sum;
}

}  // namespace

TEST_CASE("ray counts are rounded up to whole groups", "[direction_set]") {
  for (const auto& [rays, size] : {std::pair{1, 16}, {16, 16}, {17, 32}, {256, 256}, {1000, 1008}}) {
    const DirectionSet set(rays, 3);
    CHECK(set.size() == size);
    CHECK(set.groups() == size / 16);
  }
}

TEST_CASE("directions are unit vectors above the horizon, and a group knows its lowest", "[direction_set]") {
  for (const int rays : {16, 256, 4096, 65536}) {
    const DirectionSet set(rays, 1);
    for (int g = 0; g < set.groups(); ++g) {
      float lowest = 1;
      for (int i = 16 * g; i < 16 * g + 16; ++i) {
        lowest = std::min(lowest, set.z()[i]);
        // Each component is rounded once: the squared length moves by 2 |d . rounding|, at most sqrt(3) roundings of 1.
        REQUIRE(std::abs(dot(direction(set, i), direction(set, i)) - 1) < 2 * std::sqrt(3.0) * kHalfUlp);
        REQUIRE(set.z()[i] > 0);
      }
      REQUIRE(set.lowestZ(g) == lowest);
    }
  }
}

TEST_CASE("every ring of equal cosine-weighted area holds one direction, a golden angle from the last",
          "[direction_set]") {
  for (const int rays : {16, 256, 10000}) {
    const DirectionSet set(rays, 1);
    const std::vector<int> order = latticeOrder(set);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vec3d d = direction(set, order[i]);
      const double share = (double(i) + 0.5) / set.size();
      // A rounding of each component moves x^2 + y^2 by at most 2 |xy| roundings of |xy| <= 1, and z^2 likewise.
      REQUIRE(std::abs(d.x * d.x + d.y * d.y - share) < 4 * kHalfUlp);
      REQUIRE(std::abs(d.z * d.z - (1 - share)) < 4 * kHalfUlp);
      const double azimuth = 2 * kPi * (double(i) / std::numbers::phi);
      // x and y are rounded relative to their own size, which turns them by one rounding at most.
      REQUIRE(std::abs(std::remainder(std::atan2(d.y, d.x) - azimuth, 2 * kPi)) < 2 * kHalfUlp);
    }
  }
}

TEST_CASE("lattice means of the basis stay within the lattice's own error bounds", "[direction_set]") {
  const int order = 6;
  std::vector<double> y(36);
  for (const int rays : {16, 64, 256, 1024, 16384}) {
    const DirectionSet set(rays, order);
    const double n = set.size();
    std::vector<double> mean(36, 0);
    for (int i = 0; i < set.size(); ++i) {
      for (std::size_t k = 0; k < 36; ++k) mean[k] += double(set.basis(i)[k]) / n;
    }
    for (int l = 0; l < order; ++l) {
      for (int m = -l; m <= l; ++m) {
        // In azimuth y_lm is cos or sin of |m| phi; along u = sin^2(theta) it is g(u), sampled at (i + 1/2) / N.
        const auto g = [&](double u) {
          const double phi = m == 0 ? 0 : m > 0 ? 0 : kPi / (2 * -m);
          const Vec3d d{std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi), std::sqrt(1 - u)};
          sh::evaluate(order, d, y);
          return y[static_cast<std::size_t>(sh::index(l, m))];
        };
        // m = 0: Koksma's inequality with the midpoints' discrepancy 1/(2N). Else Abel's summation: the sums of
        // e^(i m 2 pi k / golden ratio) over any run of k stay below 1 / |sin(pi m / golden ratio)|.
        const double bound =
            m == 0 ? variation(g) / (2 * n)
                   : (std::abs(g(1)) + variation(g)) / (n * std::abs(std::sin(kPi * m / std::numbers::phi)));
        const auto i = static_cast<std::size_t>(sh::index(l, m));
        const double rounding = kHalfUlp * std::sqrt((2 * l + 1) / (4 * kPi));
        INFO("rays " << rays << ", l " << l << ", m " << m);
        CHECK(std::abs(mean[i] - set.unshadowed()[i]) <= bound + rounding);
      }
    }
  }
}

TEST_CASE("cosine-weighted moments of the height converge as the midpoint rule does", "[direction_set]") {
  for (const int rays : {16, 256, 4096}) {
    const DirectionSet set(rays, 1);
    const double n = set.size(), h = 1 / n;
    double z1 = 0, z2 = 0, z4 = 0;
    for (int i = 0; i < set.size(); ++i) {
      const double z = double(set.z()[i]);
      z1 += z / n;
      z2 += z * z / n;
      z4 += z * z * z * z / n;
    }
    // With u = sin^2: z^2 = 1 - u is linear, so exact; z^4 = (1 - u)^2 has second derivative 2, so h^2 2 / 24; z =
    // sqrt(1 - u) errs by 0.0404 h^1.5 in the last cell and by h^3 / 96 (k h)^-1.5, summed 2.613 h^1.5 / 96, before it.
    CHECK(std::abs(z2 - 1.0 / 2) < 4 * kHalfUlp);
    CHECK(std::abs(z4 - 1.0 / 3) < h * h / 12 + 8 * kHalfUlp);
    CHECK(std::abs(z1 - 2.0 / 3) < 0.068 * std::pow(h, 1.5) + 2 * kHalfUlp);
  }
}

TEST_CASE("the table holds the basis at the directions, padded with zeros", "[direction_set]") {
  for (const int order : {1, 2, 3, 4, 5, 8, 9, 16, 32}) {
    const DirectionSet set(48, order);
    const auto count = static_cast<std::size_t>(order * order);
    CHECK(set.stride() == (count + 3) / 4 * 4);
    std::vector<double> y(count);
    for (int i = 0; i < set.size(); ++i) {
      sh::evaluate(order, normalized(direction(set, i)), y);
      for (std::size_t k = 0; k < count; ++k) {
        const int l = sh::degreeOf(int(k));
        // Rounding turns the direction by up to sqrt(3) half ulps; the gradients of a band have the squared sum
        // l (l+1) (2l+1) / 4 pi; the value itself is rounded once.
        const double slope = std::sqrt(l * (l + 1) * (2 * l + 1) / (4 * kPi));
        REQUIRE(std::abs(double(set.basis(i)[k]) - y[k]) <=
                kHalfUlp * (std::sqrt(3.0) * slope + std::abs(y[k])) + 1e-14);
      }
      for (std::size_t k = count; k < set.stride(); ++k) REQUIRE(set.basis(i)[k] == 0);
    }
  }
}

TEST_CASE("group sums are the sums of their rows", "[direction_set]") {
  const DirectionSet set(256, 5);
  for (int g = 0; g < set.groups(); ++g) {
    for (std::size_t k = 0; k < set.stride(); ++k) {
      double sum = 0, size = 0;
      for (int i = 16 * g; i < 16 * g + 16; ++i) {
        sum += double(set.basis(i)[k]);
        size += std::abs(double(set.basis(i)[k]));
      }
      REQUIRE(std::abs(double(set.groupSum(g)[k]) - sum) <= 15 * kHalfUlp * size);  // fifteen additions
    }
  }
}

TEST_CASE("lattice and residual together are the closed form", "[direction_set]") {
  for (const int order : {1, 4, 8, 9, 32}) {
    const DirectionSet set(256, order);
    std::vector<double> exact(static_cast<std::size_t>(order * order));
    sh::unshadowedTransfer(order, {0, 0, 1}, 1, exact);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      double mean = 0, size = 0;
      for (int i = 0; i < set.size(); ++i) {
        mean += double(set.basis(i)[k]) / set.size();
        size += std::abs(double(set.basis(i)[k])) / set.size();
      }
      CHECK(set.unshadowed()[k] == exact[k]);
      CHECK(std::abs(mean + set.residual()[k] - exact[k]) <= kHalfUlp * size + 1e-15);  // rows are rounded once
    }
  }
}

TEST_CASE("bits next to each other in a group's 4 x 4 grid are next to each other on the disc", "[direction_set]") {
  for (const int rays : {16, 256, 1040, 4096}) {
    const DirectionSet set(rays, 1);
    for (int g = 0; g < set.groups(); ++g) {
      const auto isGrid = [&](const float* across, const float* along) {
        for (int row = 0; row < 4; ++row) {
          const int first = 16 * g + 4 * row;
          if (!std::is_sorted(along + first, along + first + 4)) return false;
          if (row == 0) continue;
          const float last = *std::max_element(across + first - 4, across + first);
          if (last > *std::min_element(across + first, across + first + 4)) return false;
        }
        return true;
      };
      REQUIRE((isGrid(set.x(), set.y()) || isGrid(set.y(), set.x())));
    }
  }
}

TEST_CASE("groups are tight: their bounds on the disc do not overlap", "[direction_set]") {
  const DirectionSet set(2048, 1);
  struct Box {
    float lowX, highX, lowY, highY;
  };
  std::vector<Box> boxes;
  for (int g = 0; g < set.groups(); ++g) {
    const auto [lowX, highX] = std::minmax_element(set.x() + 16 * g, set.x() + 16 * g + 16);
    const auto [lowY, highY] = std::minmax_element(set.y() + 16 * g, set.y() + 16 * g + 16);
    boxes.push_back({*lowX, *highX, *lowY, *highY});
  }
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      const Box &p = boxes[a], &q = boxes[b];
      REQUIRE((p.highX < q.lowX || q.highX < p.lowX || p.highY < q.lowY || q.highY < p.lowY));
    }
  }
}
