// Rotation by Euler angles: agreement with the recursion everywhere, and Green's printed matrices and identities.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/rotation.h"
#include "sh/support.h"
#include "sh/zyz_rotation.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

namespace {

constexpr double kBetas[] = {0, 1e-300, 1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3, 0.4, kPi / 2, 2.0};

Matrix3d zyz(double alpha, double beta, double gamma) {
  return rotationAboutZ(alpha) * rotationAboutY(beta) * rotationAboutZ(gamma);
}

Matrix3d matrixOf(const EulerZyz& e) {
  const auto z = [](Turn t) { return Matrix3d{{{{t.cosine, -t.sine, 0}, {t.sine, t.cosine, 0}, {0, 0, 1}}}}; };
  const Matrix3d y{{{{e.beta.cosine, 0, e.beta.sine}, {0, 1, 0}, {-e.beta.sine, 0, e.beta.cosine}}}};
  return z(e.alpha) * y * z(e.gamma);
}

}  // namespace

TEST_CASE("Euler angles give their matrix back, at and near both poles") {
  for (const double near : kBetas) {
    for (const double beta : {near, kPi - near}) {
      for (int trial = 0; trial < 10; ++trial) {
        const Matrix3d r = zyz(7 * hashUnit(80, trial), beta, -7 * hashUnit(81, trial));
        REQUIRE(difference(matrixOf(eulerZyz(r)), r) < 1e-15);
      }
    }
  }
}

TEST_CASE("erratum: sqrt(1 - R_zz^2) loses a small beta, a measured length does not") {
  const double beta = 1e-9;
  const Matrix3d r = zyz(0.5, beta, 0.2);
  REQUIRE(std::sqrt(1 - r(2, 2) * r(2, 2)) == 0);
  REQUIRE(eulerZyz(r).beta.sine == Approx(beta).epsilon(1e-6));
}

TEST_CASE("erratum: the printed identities for the angles are those of the transposed matrix") {
  const double alpha = 0.5, beta = 0.8, gamma = 1.3;
  const auto printedCosines = [&](const Matrix3d& r) {
    const double s = std::sqrt(1 - r(2, 2) * r(2, 2));
    return std::array{r(2, 0) / s - std::cos(alpha), -r(0, 2) / s - std::cos(gamma)};
  };
  const Matrix3d r = zyz(alpha, beta, gamma);
  for (const double error : printedCosines(transposed(r))) REQUIRE(std::abs(error) < 1e-15);
  for (const double error : printedCosines(r)) REQUIRE(std::abs(error) > 0.1);
  const EulerZyz ours = eulerZyz(r);
  REQUIRE(ours.alpha.cosine == Approx(std::cos(alpha)).epsilon(1e-15));
  REQUIRE(ours.gamma.cosine == Approx(std::cos(gamma)).epsilon(1e-15));
}

TEST_CASE("Euler form and recursion agree to 1e-12 at order 33, at and near beta = 0 and pi too") {
  const int order = 33;
  const ZyzRotation euler(order);
  const auto c = randomCoefficients(order, 82);
  std::vector<double> a(c.size()), b(c.size());
  for (const double near : kBetas) {
    for (const double beta : {near, kPi - near}) {
      const Matrix3d r = zyz(0.7, beta, -1.9);
      Rotation(order, r).apply(c, a);
      euler.apply(r, c, b);
      REQUIRE(maxDifference(a, b) < 1e-12);
    }
  }
}

TEST_CASE("Euler form and recursion agree at order 65 within the recursion's own error") {
  const int order = 65;
  const auto c = randomCoefficients(order, 83);
  std::vector<double> a(c.size()), b(c.size());
  const Matrix3d r = rotationAbout({1, 2, 3}, 1.1);
  Rotation(order, r).apply(c, a);
  ZyzRotation(order).apply(r, c, b);
  // 129 entries in error by at most 2e-11, of random signs, times coefficients below 1.
  REQUIRE(maxDifference(a, b) < 2e-11 * std::sqrt(129.0));
  // The Euler form itself loses nothing: length is kept to rounding, there and at the highest order.
  for (const int high : {65, kMaxTurnOrder}) {
    const auto big = randomCoefficients(high, 84);
    std::vector<double> turned(big.size());
    ZyzRotation(high).apply(r, big, turned);
    double before = 0, after = 0;
    for (const double v : big) before += v * v;
    for (const double v : turned) after += v * v;
    REQUIRE(std::abs(after / before - 1) < 1e-13);
  }
}

TEST_CASE("Green's quarter turns bear the right names without Condon-Shortley phase, and swap them with it") {
  const double h = std::sqrt(3.0) / 2;
  double printedMinus[9][9] = {};
  printedMinus[0][0] = 1;
  printedMinus[1][2] = 1;
  printedMinus[2][1] = -1;
  printedMinus[3][3] = 1;
  printedMinus[4][7] = 1;
  printedMinus[5][5] = -1;
  printedMinus[6][6] = -0.5;
  printedMinus[6][8] = printedMinus[8][6] = -h;
  printedMinus[7][4] = -1;
  printedMinus[8][8] = 0.5;
  const Rotation minus(3, rotationAboutX(-kPi / 2)), plus(3, rotationAboutX(kPi / 2));
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      if (degreeOf(i) != degreeOf(j)) continue;
      REQUIRE(std::abs(printedMinus[i][j] - minus.entry(degreeOf(i), orderOf(i), orderOf(j))) < 1e-15);
      const double phase = (orderOf(i) + orderOf(j)) % 2 == 0 ? 1 : -1;
      const double withPhase = phase * plus.entry(degreeOf(i), orderOf(i), orderOf(j));
      REQUIRE(std::abs(printedMinus[i][j] - withPhase) < 1e-15);
    }
  }
}

TEST_CASE("rotation about z is the printed matrix; m = 0 stays") {
  const double a = 0.6;
  const Rotation r(3, rotationAboutZ(a));
  REQUIRE(r.entry(2, 0, 0) == Approx(1).epsilon(1e-15));
  for (int m = 1; m <= 2; ++m) {
    REQUIRE(r.entry(2, -m, -m) == Approx(std::cos(m * a)).epsilon(1e-15));
    REQUIRE(r.entry(2, -m, m) == Approx(std::sin(m * a)).epsilon(1e-15));
    REQUIRE(r.entry(2, m, -m) == Approx(-std::sin(m * a)).epsilon(1e-15));
    REQUIRE(r.entry(2, m, m) == Approx(std::cos(m * a)).epsilon(1e-15));
  }
}

TEST_CASE("erratum: Green's eq. 11 is Z(alpha) X Z(beta) X Z(gamma), not the order of his text") {
  const double ca = std::cos(0.5), sa = std::sin(0.5), cb = std::cos(0.8), sb = std::sin(0.8), cg = std::cos(1.3),
               sg = std::sin(1.3);
  const double printed[3][3] = {{ca * cg - sa * sg * cb, sa * sb, ca * sg + sa * cg * cb},
                                {sg * sb, cb, -cg * sb},
                                {-ca * sg * cb - sa * cg, ca * sb, ca * cg * cb - sa * sg}};
  const auto errorFor = [&](const Matrix3d& matrix) {
    const Rotation r(2, matrix);
    double largest = 0;
    for (int m = -1; m <= 1; ++m) {
      for (int n = -1; n <= 1; ++n) largest = std::max(largest, std::abs(printed[m + 1][n + 1] - r.entry(1, m, n)));
    }
    return largest;
  };
  REQUIRE(errorFor(zyz(0.5, 0.8, 1.3)) < 1e-15);
  REQUIRE(errorFor(zyz(1.3, 0.8, 0.5)) > 0.1);
}

TEST_CASE("Euler rotations work in place and refuse arrays that are too short") {
  const ZyzRotation euler(4);
  const Matrix3d r = rotationAbout({3, 1, -2}, 2.2);
  auto c = randomCoefficients(4, 85);
  std::vector<double> out(16), eight(8);
  euler.apply(r, c, out);
  euler.apply(r, c, c);
  REQUIRE(c == out);
  REQUIRE_THROWS_AS(euler.apply(r, c, eight), Error);
  REQUIRE_THROWS_AS(euler.apply(r, eight, c), Error);
  REQUIRE_THROWS_AS(ZyzRotation(kMaxTurnOrder + 1), Error);
}
