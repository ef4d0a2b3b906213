// Rows about the mathematics of spherical harmonics: factorials, poles, printed formulas, ringing.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/hash.h"
#include "sh/irradiance.h"
#include "sh/quadrature.h"
#include "sh/rotation.h"
#include "sh/zonal.h"
#include "stability/families.h"

namespace shbake::stability {
namespace {

using std::numbers::pi;
constexpr std::uint64_t kSeed = 411;

Vec3d randomDirection(std::uint64_t i) {
  const double z = 2 * hashUnit(kSeed, 2 * i) - 1, phi = 2 * pi * hashUnit(kSeed, 2 * i + 1);
  return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
}

double factorial(int n) {
  double product = 1;
  for (int i = 2; i <= n; ++i) product *= i;
  return product;
}

bool differ(double a, double b, double tolerance) {
  return !(std::abs(a - b) <= tolerance);  // NaN differs
}

// ---- Values of the basis.

/// Green's K(l, m) and P(l, m, x) ("The Gritty Details", 2003), for all degrees below `order`, without phase.
std::vector<double> textbookBasis(int order, const Vec3d& d) {
  const double phi = std::atan2(d.y, d.x), sine = std::sqrt((1 - d.z) * (1 + d.z));
  std::vector<double> out(static_cast<std::size_t>(order) * order);
  double sectoral = 1;  // P_mm
  for (int m = 0; m < order; ++m) {
    if (m > 0) sectoral *= (2 * m - 1) * sine;
    double before = 0, legendre = sectoral;
    for (int l = m; l < order; ++l) {
      if (l > m) {
        const double next = (d.z * (2 * l - 1) * legendre - (l + m - 1) * before) / (l - m);
        before = legendre;
        legendre = next;
      }
      const double k = std::sqrt((2 * l + 1) / (4 * pi) * factorial(l - m) / factorial(l + m));
      out[sh::index(l, m)] = (m == 0 ? 1 : std::numbers::sqrt2) * k * std::cos(m * phi) * legendre;
      if (m > 0) out[sh::index(l, -m)] = std::numbers::sqrt2 * k * std::sin(m * phi) * legendre;
    }
  }
  return out;
}

/// The addition theorem: the squares of a degree sum to (2l+1) / 4 pi in every direction. Values of degree l are good
/// to (10 + l^2) 2^-52 of sqrt((2l+1) / 4 pi), and 2l + 1 of them to sqrt(2l + 1) times twice that.
Count againstAdditionTheorem(int order, const std::vector<double>& y) {
  Count count;
  for (int l = 0; l < order; ++l) {
    double sum = 0;
    for (int m = -l; m <= l; ++m) sum += y[sh::index(l, m)] * y[sh::index(l, m)];
    count.add(differ(sum * 4 * pi / (2 * l + 1), 1, 2 * std::sqrt(2 * l + 1.0) * (10 + 1.0 * l * l) * 0x1p-52));
  }
  return count;
}

Outcome measureBasis(const Bench& bench) {
  const int order = bench.brief ? 201 : 1001;
  Outcome outcome;
  std::vector<double> y(static_cast<std::size_t>(order) * order);
  std::vector<Vec3d> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1e-9, 0, 1}, {0, -1e-200, -1}};
  for (std::uint64_t i = 0; i < 3; ++i) directions.push_back(randomDirection(i));
  for (const Vec3d& d : directions) {
    sh::evaluate(order, d, y);
    outcome.own += againstAdditionTheorem(order, y);
    outcome.naive += againstAdditionTheorem(order, textbookBasis(order, d));
    bench.progress.advance(0);
  }
  return outcome;
}

// ---- Rotation.

/// Wigner's sum for d^l_m0(beta) ("Gruppentheorie", 1931): how much of y_l0 goes to order m, as a column of factorials.
double wignerSum(int l, int m, double beta) {
  const double c = std::cos(beta / 2), s = std::sin(beta / 2);
  double sum = 0;
  for (int k = std::max(0, -m); k <= std::min(l, l - m); ++k) {
    sum += ((m + k) % 2 == 0 ? 1 : -1) * std::pow(c, 2 * l - m - 2 * k) * std::pow(s, m + 2 * k) /
           (factorial(l - k) * factorial(k) * factorial(m + k) * factorial(l - m - k));
  }
  return std::sqrt(factorial(l + m) * factorial(l - m)) * factorial(l) * sum;
}

/// Each degree l of a lobe about an axis, turned, against the lobe about the turned axis (maths.md (11)); 1e-9 of its
/// length is 50 times the stated accuracy of the recursion at order 65.
Outcome measureRotation(const Bench& bench) {
  constexpr int kOrder = 65;
  constexpr double kTolerance = 1e-9;
  Outcome outcome;
  std::vector<double> lobe(kOrder, 1.0), in(kOrder * kOrder), out(in.size()), wanted(in.size());
  for (std::uint64_t i = 0; i < (bench.brief ? 3 : 20); ++i) {
    const sh::Matrix3d r = sh::rotationAbout(randomDirection(2 * i), pi * hashUnit(kSeed, 900 + i));
    const Vec3d axis = randomDirection(2 * i + 1), pole = r * Vec3d(0, 0, 1);
    sh::rotateZonal(lobe, axis, in);
    sh::rotateZonal(lobe, r * axis, wanted);
    sh::Rotation(kOrder, r).apply(in, out);
    std::vector<double> turnedPole(in.size());
    sh::rotateZonal(lobe, pole, turnedPole);
    const double beta = std::acos(pole.z), phi = std::atan2(pole.y, pole.x);
    for (int l = 0; l < kOrder; ++l) {
      bool own = false, naive = false;
      for (int m = -l; m <= l; ++m) {
        own |= differ(out[sh::index(l, m)], wanted[sh::index(l, m)], kTolerance);
        const double d = std::abs(wignerSum(l, std::abs(m), beta)) * (m == 0 ? 1 : std::numbers::sqrt2);
        const double guess = d * std::abs(m < 0 ? std::sin(m * phi) : std::cos(m * phi));
        naive |= differ(guess, std::abs(turnedPole[sh::index(l, m)]), kTolerance);
      }
      outcome.own.add(own);
      outcome.naive.add(naive);
    }
    bench.progress.advance(0);
  }
  return outcome;
}

/// Green's identities: sin beta = sqrt(1 - R_zz^2), and alpha and gamma from quotients by it.
sh::Matrix3d throughTextbookAngles(const sh::Matrix3d& r) {
  const double sine = std::sqrt(1 - r(2, 2) * r(2, 2));
  const double alpha = std::atan2(r(1, 2) / sine, r(0, 2) / sine), gamma = std::atan2(r(2, 1) / sine, -r(2, 0) / sine);
  return sh::rotationAboutZ(alpha) * sh::rotationAboutY(std::acos(r(2, 2))) * sh::rotationAboutZ(gamma);
}

/// The matrix that a light of order 2 is turned by, whose coefficients turn like y, z, x.
sh::Matrix3d throughLight(const sh::Matrix3d& r) {
  constexpr std::array kPlace{3, 1, 2};  // of x, y, z
  sh::Matrix3d result;
  for (int column = 0; column < 3; ++column) {
    Light light(2);
    light.coefficients[kPlace[column]] = {1, 1, 1};
    const Light turned = rotated(light, r);
    for (int row = 0; row < 3; ++row) result(row, column) = turned.coefficients[kPlace[row]].x;
  }
  return result;
}

bool isAnother(const sh::Matrix3d& a, const sh::Matrix3d& b) {
  bool other = false;
  for (int i = 0; i < 9; ++i) other |= differ(a(i / 3, i % 3), b(i / 3, i % 3), 1e-14);
  return other;
}

Outcome measurePoles(const Bench&) {
  Outcome outcome;
  for (const double away : {0.0, 1e-300, 1e-17, 1e-12, 1e-9, 1e-8, 1e-6, 1e-4, 1e-2, 0.5}) {
    for (const double beta : {away, pi - away, -away}) {
      for (int i = 0; i < 12; ++i) {
        const double alpha = 2 * pi * hashUnit(kSeed, 300 + i), gamma = i % 4 == 0 ? 0 : 2 * pi * hashUnit(kSeed, i);
        const sh::Matrix3d r = sh::rotationAboutZ(alpha) * sh::rotationAboutY(beta) * sh::rotationAboutZ(gamma);
        outcome.own.add(isAnother(throughLight(r), r));
        outcome.naive.add(isAnother(throughTextbookAngles(r), r));
      }
    }
  }
  return outcome;
}

// ---- Irradiance.

/// The constants A_l of the cosine lobe as they are printed: (l!)/2 squared where (l/2)! squared is meant.
double printedLobe(int l) {
  if (l == 1) return 2 * pi / 3;
  if (l % 2 == 1) return 0;
  const double half = factorial(l) / 2;
  return 2 * pi * (l / 2 % 2 == 0 ? -1 : 1) / ((l + 2.0) * (l - 1.0)) * factorial(l) / (std::pow(2.0, l) * half * half);
}

/// 2 pi times the integral over u = 0..1 of u P_l(u), by as many nodes as make it exact.
double integratedLobe(int l, const sh::IntervalRule& rule) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double u = (rule.nodes[i] + 1) / 2;
    double before = 0, legendre = 1;
    for (int k = 1; k <= l; ++k) {
      const double next = ((2 * k - 1) * u * legendre - (k - 1) * before) / k;
      before = legendre;
      legendre = next;
    }
    sum += rule.weights[i] / 2 * u * legendre;
  }
  return 2 * pi * sum;
}

Outcome measureCosineLobe(const Bench& bench) {
  const int degrees = bench.brief ? 100 : 400;
  const sh::IntervalRule rule = sh::gaussLegendre(degrees / 2 + 1);
  Outcome outcome;
  for (int l = 0; l < degrees; ++l) {
    const double exact = integratedLobe(l, rule);  // its 200 terms below 1 round to 1e-14 together
    outcome.own.add(differ(sh::cosineLobe(l), exact, 1e-13));
    outcome.naive.add(differ(printedLobe(l), exact, 1e-13));
  }
  return outcome;
}

/// The non-linear form of order 2 as it is written in shaders, in single precision.
float shaderNonlinear(float r0, const Vec3f& r1, const Vec3f& n) {
  const float l = length(r1), ratio = l / r0;
  const float q = 0.5f * (1 + dot(r1 * (1 / l), n)), p = 1 + 2 * ratio, a = (1 - ratio) / (1 + ratio);
  return r0 * (a + (1 - a) * (p + 1) * std::pow(q, p));
}

Outcome measureNonlinear(const Bench&) {
  Outcome outcome;
  for (const double ratio : {0.0, 1e-300, 1e-160, 1e-30, 1e-8, 0.5, 1 - 1e-12, 1.0, 1.0 + 1e-7}) {
    for (std::uint64_t i = 0; i < 40; ++i) {
      const Vec3d axis = randomDirection(i), other = randomDirection(1000 + i);
      // Along the light, against it, and anywhere.
      const Vec3d normal = i % 4 == 0 ? axis : i % 4 == 1 ? -axis : other;
      const long double r = std::min(1.0L, static_cast<long double>(ratio));
      const long double q = std::max(0.0L, (1 + static_cast<long double>(dot(axis, normal))) / 2);
      const long double a = (1 - r) / (1 + r), p = 1 + 2 * r;
      const double exact = static_cast<double>(a + (1 - a) * (p + 1) * std::pow(q, p));
      // Half of the last of 24 bits, of a power whose exponent is 3, and of values up to 4: what float can hold.
      const double tolerance = 1e-6;
      outcome.own.add(differ(sh::diffuseNonlinear(1, axis * ratio, normal), exact, tolerance));
      outcome.naive.add(differ(shaderNonlinear(1, Vec3f(axis * ratio), Vec3f(normal)), exact, tolerance));
    }
  }
  return outcome;
}

// ---- Ringing.

/// Whether radiance is negative somewhere on 8000 directions, beyond 1e-6 of the greatest.
bool rings(const Light& light) {
  constexpr int kCount = 8000;
  const double golden = pi * (3 - std::sqrt(5.0));
  double least = 0, most = 0;
  for (int k = 0; k < kCount; ++k) {
    const double z = 1 - (2 * k + 1.0) / kCount, r = std::sqrt((1 - z) * (1 + z));
    const double value = radianceFrom(light, {r * std::cos(golden * k), r * std::sin(golden * k), z}).x;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return least < -1e-6 * most;
}

Outcome measureRinging(const Bench& bench) {
  Outcome outcome;
  for (int order = 3; order <= (bench.brief ? 5 : 10); ++order) {
    for (const double halfAngle : {0.27, 10.0, 45.0}) {
      for (std::uint64_t i = 0; i < 3; ++i) {
        Light light = discLight(order, randomDirection(i), halfAngle, {1, 1, 1});
        if (i > 0)
          addLight(light, discLight(order, randomDirection(10 + i), 2 * halfAngle, {1, 1, 1}), {0.2, 0.2, 0.2});
        outcome.naive.add(rings(light));
        applyWindow(sh::Window::automatic, {&light, 1});
        outcome.own.add(rings(light));
      }
      bench.progress.advance(0);
    }
  }
  return outcome;
}

constexpr Row kRows[] = {
    {"basis-degree", "sh", "values of the basis at high degree", "NaN or zero light as soon as the order is raised",
     "normalisation by factorials, Legendre functions without it", "a recurrence of normalised functions", "--order",
     "a degree in a direction fails when the squares of its values do not sum to (2l+1) / 4 pi", 0, measureBasis},
    {"rotation-degree", "sh", "rotation at high degree", "a light that changes its shape while it is turned",
     "Wigner's sum of factorials", "recursion over the degree, with the errors of the printed forms mended",
     "sh --turn, light --turn", "a degree of a turned lobe fails when it is off by 1e-9", 0, measureRotation},
    {"rotation-poles", "sh", "turns about the vertical axis, and nearly so",
     "a light that jumps when it is tilted a little", "Euler angles by quotients of sin beta",
     "lengths measured directly; what one angle loses the other gains", "sh --turn, light --turn",
     "a rotation fails when an entry of what it does is off by 1e-14", 0, measurePoles},
    {"cosine-lobe", "sh", "constants of the cosine lobe", "diffuse light that is too flat, or NaN at high orders",
     "the formula as it is printed in a much copied text", "products of ratios, checked against the integral",
     "bake --transfer unshadowed", "a degree fails when A_l is off by 1e-13", 0, measureCosineLobe},
    {"nonlinear-ends", "sh", "non-linear irradiance of even light and of one direction",
     "black or flickering spots where light is even", "the formula in single precision, as in shaders",
     "limits at both ends, ratios above 1 taken as 1", "sh::diffuseNonlinear()",
     "a light and a normal fail when the value is off by 1e-6 of the mean", 0, measureNonlinear},
    {"ringing", "sh", "small suns in few bands", "dark rings, and black spots opposite the sun", "bands cut off",
     "the least window that leaves nothing negative", "--window auto",
     "a light fails when it is negative in some direction by 1e-6 of its greatest value", 0, measureRinging},
};

}  // namespace

std::span<const Row> shRows() {
  return kRows;
}

}  // namespace shbake::stability
