// Rotation matrices of spherical harmonics, and the printed forms of the recursion that are not rotations.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/projection.h"
#include "sh/quadrature.h"
#include "sh/rotation.h"
#include "sh/support.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

namespace {

Matrix3d randomRotation(std::uint64_t seed) {
  return rotationAbout(randomDirection(60, seed), 2 * kPi * hashUnit(61, seed));
}

double orthogonalityError(const Rotation& r) {
  double largest = 0;
  for (int l = 0; l < r.order(); ++l) {
    for (int a = -l; a <= l; ++a) {
      for (int b = -l; b <= l; ++b) {
        double sum = 0;
        for (int k = -l; k <= l; ++k) sum += r.entry(l, a, k) * r.entry(l, b, k);
        largest = std::max(largest, std::abs(sum - (a == b ? 1 : 0)));
      }
    }
  }
  return largest;
}

/// Band 3 by the recursion as Green's appendix prints it, with the two misprints switched on one by one. Rows outside a
/// band, which the printed w asks for, count as zero.
double printedOrthogonalityError(const Matrix3d& matrix, bool printedV, bool printedW) {
  const Rotation exact(3, matrix);
  constexpr int l = 3;
  const auto before = [&](int a, int b) { return std::abs(a) > l - 1 ? 0 : exact.entry(l - 1, a, b); };
  const auto one = [&](int i, int j) { return exact.entry(1, i, j); };
  const auto p = [&](int i, int a, int b) {
    if (b == l) return one(i, 1) * before(a, l - 1) - one(i, -1) * before(a, 1 - l);
    if (b == -l) return one(i, 1) * before(a, 1 - l) + one(i, -1) * before(a, l - 1);
    return one(i, 0) * before(a, b);
  };
  const auto entry = [&](int m, int n) {
    const int a = std::abs(m);
    const double scale = std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1);
    const double d0 = m == 0, d1 = a == 1;
    const double u = std::sqrt((l + m) * (l - m) / scale);
    const double v = 0.5 * std::sqrt((1 + d0) * (l + a - 1) * (l + a) / scale) * (1 - 2 * d0);
    const int wSign = printedW && std::abs(n) == l ? 1 : -1;
    const double w = -0.5 * std::sqrt((l + wSign * a - 1) * (l + wSign * a) / scale) * (1 - d0);
    double bigV = p(1, 1, n) + p(-1, -1, n);
    if (m > 0) bigV = p(1, m - 1, n) * std::sqrt(1 + d1) - p(-1, 1 - m, n) * (1 - d1);
    if (m < 0 && !printedV) bigV = p(1, m + 1, n) * (1 - d1) + p(-1, -m - 1, n) * std::sqrt(1 + d1);
    if (m < 0 && printedV) bigV = p(1, m + 1, n) * (1 + d1) + p(-1, -m - 1, n) * std::sqrt(1 - d1);
    const double bigW = m > 0 ? p(1, m + 1, n) + p(-1, -m - 1, n) : p(1, m - 1, n) - p(-1, 1 - m, n);
    return u * p(0, m, n) + v * bigV + (m == 0 ? 0 : w * bigW);
  };
  double largest = 0;
  for (int a = -l; a <= l; ++a) {
    for (int b = -l; b <= l; ++b) {
      double sum = 0;
      for (int n = -l; n <= l; ++n) sum += entry(a, n) * entry(b, n);
      largest = std::max(largest, std::abs(sum - (a == b ? 1 : 0)));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("rotated coefficients are the rotated function") {
  for (const int order : {1, 2, 3, 5, 9, 17, 33}) {
    for (int trial = 0; trial < 4; ++trial) {
      const Matrix3d r = randomRotation(trial);
      const Rotation rotation(order, r);
      const auto before = randomCoefficients(order, 70 + trial);
      std::vector<double> after(before.size());
      rotation.apply(before, after);
      for (int i = 0; i < 10; ++i) {
        const Vec3d d = randomDirection(71, i);
        // What shone from d shines from R d. Degree l magnifies the rounding of the direction by l.
        REQUIRE(std::abs(valueAt(order, after, r * d) - valueAt(order, before, d)) < 1e-15 * (20 + 2 * order * order));
      }
    }
  }
}

TEST_CASE("absolute directions: light from z turned about y by 90 degrees comes from x") {
  const Rotation rotation(2, rotationAboutY(kPi / 2));
  std::vector<double> fromZ{0, 0, 1, 0}, turned(4);
  rotation.apply(fromZ, turned);
  REQUIRE(maxDifference(turned, std::vector<double>{0, 0, 0, 1}) < 1e-15);
}

TEST_CASE("rotation matrices are orthogonal") {
  for (int trial = 0; trial < 6; ++trial) {
    REQUIRE(orthogonalityError(Rotation(9, randomRotation(trial))) < 3e-15);
    REQUIRE(orthogonalityError(Rotation(33, randomRotation(trial))) < 1e-13);
  }
  for (int trial = 0; trial < 3; ++trial) REQUIRE(orthogonalityError(Rotation(65, randomRotation(trial))) < 2e-11);
}

TEST_CASE("the matrix is the integral of y_i(R s) y_j(s), and maps coefficients as documented") {
  const int order = 5;
  const Matrix3d r = randomRotation(7);
  const Rotation rotation(order, r);
  const int count = coefficientCount(order);
  std::vector<double> m(count * count);
  SphereRule(2 * (order - 1)).forEach([&](const Vec3d& s, double weight) {
    const auto turned = basisAt(order, normalized(r * s)), plain = basisAt(order, s);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) m[i * count + j] += weight * turned[i] * plain[j];
    }
  });
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const bool sameBand = degreeOf(i) == degreeOf(j);
      const double expected = sameBand ? rotation.entry(degreeOf(i), orderOf(i), orderOf(j)) : 0;
      REQUIRE(std::abs(m[i * count + j] - expected) < 1e-14);
    }
  }

  // Erratum: Green has M map f to g(s) = f(R s). That is the transpose's work; M turns the function forward.
  const auto f = randomCoefficients(order, 72);
  const auto g = project(
      order, [&](const Vec3d& s) { return valueAt(order, f, normalized(r * s)); }, order - 1);
  std::vector<double> byMatrix(f.size()), byTranspose(f.size());
  rotation.apply(f, byMatrix);
  rotation.inverse().apply(f, byTranspose);
  REQUIRE(maxDifference(byTranspose, g) < 1e-13);
  REQUIRE(maxDifference(byMatrix, g) > 0.1);
}

TEST_CASE("projecting the rotated function is rotating the projection") {
  const int order = 9;
  const Matrix3d r = randomRotation(8);
  const auto f = [](const Vec3d& d) { return d.x * d.x * d.x * d.y + 2 * d.z * d.z * d.x - d.y * d.z + 0.3; };
  const auto plain = project(order, f, 4);
  std::vector<double> rotated(plain.size());
  Rotation(order, r).apply(plain, rotated);
  const Matrix3d back = transposed(r);
  const auto direct = project(
      order, [&](const Vec3d& d) { return f(back * d); }, 4);
  REQUIRE(maxDifference(rotated, direct) < 1e-12);
}

TEST_CASE("composition and inverse") {
  const Matrix3d a = randomRotation(9), b = randomRotation(10);
  const int order = 9;
  const auto c = randomCoefficients(order, 73);
  std::vector<double> once(c.size()), twice(c.size()), composed(c.size()), product(c.size());
  Rotation(order, b).apply(c, once);
  Rotation(order, a).apply(once, twice);
  (Rotation(order, a) * Rotation(order, b)).apply(c, composed);
  Rotation(order, a * b).apply(c, product);
  REQUIRE(maxDifference(twice, composed) < 2e-14);
  REQUIRE(maxDifference(twice, product) < 2e-14);
  Rotation(order, b).inverse().apply(once, twice);
  REQUIRE(maxDifference(twice, c) < 2e-14);
}

TEST_CASE("single-precision coefficients rotate to the double result within rounding") {
  const int order = 9;
  const Rotation rotation(order, randomRotation(11));
  const auto c = randomCoefficients(order, 74);
  const std::vector<float> single(c.begin(), c.end());
  const std::vector<double> rounded(single.begin(), single.end());
  std::vector<float> out(c.size());
  std::vector<double> twin(c.size());
  rotation.apply(single, out);
  rotation.apply(rounded, twin);
  for (std::size_t i = 0; i < out.size(); ++i) REQUIRE(out[i] == static_cast<float>(twin[i]));
}

TEST_CASE("errata: the printed recursion is not orthogonal") {
  const Matrix3d r = randomRotation(12);
  REQUIRE(printedOrthogonalityError(r, false, false) < 2e-15);
  REQUIRE(printedOrthogonalityError(r, true, false) > 0.1);
  REQUIRE(printedOrthogonalityError(r, false, true) > 1e-3);
}

TEST_CASE("rotations refuse what they cannot do") {
  REQUIRE_THROWS_AS(Rotation(0, Matrix3d{}), Error);
  REQUIRE_THROWS_AS(Rotation(3, Matrix3d{{{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}), Error);
  const Rotation rotation(3, Matrix3d{});
  std::vector<double> nine(9), eight(8);
  REQUIRE_THROWS_AS(rotation.apply(nine, eight), Error);
  REQUIRE_THROWS_AS(rotation.apply(eight, nine), Error);
  REQUIRE_THROWS_AS(rotation.apply(nine, nine), Error);
  REQUIRE_THROWS_AS(rotation * Rotation(4, Matrix3d{}), Error);
}
