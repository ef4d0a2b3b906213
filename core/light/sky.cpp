// Standard skies: Moon and Spencer, "Illumination from a non-uniform sky", 1942 (CIE overcast sky, 1955); Kittler,
// "Standardisation of outdoor conditions for the calculation of daylight factor with clear skies", 1967 (CIE clear sky,
// 1973); the intermediate sky has its form with other constants. A much copied text prints the overcast sky with the
// angle from the zenith where elevation is meant, and the partly cloudy one with cos gamma for cos theta: with either,
// the radiance at the zenith is not Lz. tests/light/test_sky.cpp holds both.
#include "light/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "sh/basis.h"
#include "sh/quadrature.h"
#include "sh/z_rotation.h"
#include "sh/zonal.h"

namespace shbake {
namespace {

using std::numbers::pi;

constexpr std::array<std::pair<SkyModel, const char*>, 3> kNames{{
    {SkyModel::overcast, "overcast"},
    {SkyModel::clear, "clear"},
    {SkyModel::partlyCloudy, "partly-cloudy"},
}};

/// The skies with a sun: (a + b exp(c gamma) + d cos^2 gamma)(1 - exp(e / cos theta)), divided by itself at the zenith.
struct SunSky {
  double a, b, c, d, e;

  double indicatrix(double gamma) const {
    const double cosine = std::cos(gamma);
    return a + b * std::exp(c * gamma) + d * cosine * cosine;
  }
  /// `z` = cos theta is 0 or more; at the horizon the exponential has vanished.
  double gradation(double z) const { return z > 0 ? -std::expm1(e / z) : 1; }
};
constexpr SunSky kClear{0.91, 10, -3, 0.45, -0.32};
constexpr SunSky kPartlyCloudy{0.526, 5, -1.5, 0, -0.8};

const SunSky& sunSky(SkyModel model) {
  return model == SkyModel::clear ? kClear : kPartlyCloudy;
}

double radians(double degrees) {
  return degrees * pi / 180;
}

void requireValid(const SkyOptions& options) {
  const auto within = [](const Vec3d& v, double most) {
    return isFinite(v) && std::min({v.x, v.y, v.z}) >= 0 && std::max({v.x, v.y, v.z}) <= most;
  };
  if (!within(options.zenith, 1e30)) throw usageError("the zenith's radiance is negative or too large", "give 0..1e30");
  if (!within(options.groundAlbedo, 1)) throw usageError("the ground's albedo is out of range", "give 0..1");
  if (!(options.sunAltitude >= 0 && options.sunAltitude <= 90)) {
    throw usageError("the sun's altitude is out of range", "give 0..90 degrees above the horizon");
  }
  if (!std::isfinite(options.sunAzimuth))
    throw usageError("the sun's azimuth is not finite", "give degrees from north");
}

/// Radiance relative to the zenith's, from the cosine z >= 0 of the angle to the zenith and the angle gamma to the sun.
double relativeRadiance(const SkyOptions& options, double z, double gamma) {
  if (options.model == SkyModel::overcast) return (1 + 2 * z) / 3;
  const SunSky& sky = sunSky(options.model);
  const double sunFromZenith = pi / 2 - radians(options.sunAltitude);
  return sky.indicatrix(gamma) * sky.gradation(z) / (sky.indicatrix(sunFromZenith) * sky.gradation(1));
}

/// Sums over the sky above the horizon, relative to the zenith's radiance and with the sun in the half plane y = 0, x >
/// 0: coefficients (those with m < 0 vanish) and irradiance.
struct SkySums {
  std::vector<double> coefficients;
  double irradiance = 0;

  explicit SkySums(int order) : coefficients(sh::coefficientCount(order)), scratch_(coefficients.size()) {}

  void add(int order, const Vec3d& direction, double weight) {
    sh::evaluate(order, direction, scratch_);
    for (std::size_t i = 0; i < scratch_.size(); ++i) coefficients[i] += weight * scratch_[i];
    irradiance += weight * direction.z;
  }

 private:
  std::vector<double> scratch_;
};

/// Integrates in polar angles (gamma, psi) about the sun, where exp(c gamma) has no kink: rings of gamma up to the
/// horizon, then the arcs of rings that are above it. psi is measured from the direction of the zenith; by symmetry
/// half of each ring is enough. `nodes` are used in each angle and piece.
SkySums integrateAboutSun(int order, const SkyOptions& options, int nodes) {
  const double altitude = radians(options.sunAltitude), sinA = std::sin(altitude), cosA = std::cos(altitude);
  const Vec3d sun{cosA, 0, sinA}, toZenith{-sinA, 0, cosA}, sideways{0, 1, 0};
  const sh::IntervalRule rule = sh::gaussLegendre(nodes);
  SkySums sums(order);
  const auto addRing = [&](double gamma, double weight, double halfArc) {
    const double sinG = std::sin(gamma), cosG = std::cos(gamma);
    for (int k = 0; k < nodes; ++k) {
      const double psi = halfArc * (1 + rule.nodes[k]) / 2;
      const Vec3d d = cosG * sun + sinG * std::cos(psi) * toZenith + sinG * std::sin(psi) * sideways;
      // Twice: psi and -psi. y_lm with m < 0 are odd in y and cancel, which leaving them out below does exactly.
      const double area = 2 * weight * sinG * rule.weights[k] * halfArc / 2;
      sums.add(order, d, area * relativeRadiance(options, std::max(d.z, 0.0), gamma));
    }
  };
  for (int k = 0; k < nodes; ++k) {
    const double u = (1 + rule.nodes[k]) / 2, w = rule.weights[k] / 2;
    // The length of the arcs begins and ends like a square root; gamma = u^2 (3 - 2u) makes that smooth.
    const double span = pi - 2 * altitude, gamma = altitude + span * u * u * (3 - 2 * u);
    if (altitude > 0) addRing(altitude * u, altitude * w, pi);
    // z = cos gamma sin A + sin gamma cos A cos psi = 0 ends the arc.
    const double end = -std::cos(gamma) * sinA / (std::sin(gamma) * cosA);
    if (span > 1e-12) addRing(gamma, span * 6 * u * (1 - u) * w, std::acos(std::clamp(end, -1.0, 1.0)));
  }
  for (int i = 0; i < sh::coefficientCount(order); ++i) {
    if (sh::orderOf(i) < 0) sums.coefficients[i] = 0;
  }
  return sums;
}

/// The overcast sky: a polynomial in z on the upper half, exact by Gauss-Legendre.
SkySums integrateOvercast(int order) {
  SkySums sums(order);
  const double horizon[] = {0};
  const auto profile = [](double z) { return z < 0 ? 0 : (1 + 2 * z) / 3; };
  const std::vector<double> zonal = sh::projectZonal(order, profile, horizon, order / 2 + 2);
  for (int l = 0; l < order; ++l) sums.coefficients[sh::index(l, 0)] = zonal[l];
  sums.irradiance = 7 * pi / 9;
  return sums;
}

double largestChange(const SkySums& a, const SkySums& b) {
  double largest = std::abs(a.irradiance - b.irradiance);
  for (std::size_t i = 0; i < a.coefficients.size(); ++i) {
    largest = std::max(largest, std::abs(a.coefficients[i] - b.coefficients[i]));
  }
  return largest;
}

/// Doubles the nodes until the coefficients stand still: the last step's change bounds the error of the one before.
SkySums integrateSky(int order, const SkyOptions& options) {
  if (options.model == SkyModel::overcast) return integrateOvercast(order);
  constexpr int kMostNodes = 4096;
  int nodes = 32 + order;
  SkySums before = integrateAboutSun(order, options, nodes);
  while (true) {
    nodes *= 2;
    SkySums sums = integrateAboutSun(order, options, nodes);
    const double scale = sums.coefficients[0] * std::sqrt(4 * pi);
    if (largestChange(before, sums) <= kSkyError * scale) return sums;
    if (nodes > kMostNodes) throw Error({.cause = "a sky's integral did not settle", .remedy = "lower the order"});
    before = std::move(sums);
  }
}

}  // namespace

const char* skyName(SkyModel model) {
  return kNames[static_cast<std::size_t>(model)].second;
}

std::optional<SkyModel> skyNamed(const std::string& name) {
  for (const auto& [model, known] : kNames) {
    if (name == known) return model;
  }
  return std::nullopt;
}

Vec3d sunDirection(const SkyOptions& options) {
  const double altitude = radians(options.sunAltitude), azimuth = radians(options.sunAzimuth);
  return {std::cos(altitude) * std::sin(azimuth), std::cos(altitude) * std::cos(azimuth), std::sin(altitude)};
}

Vec3d skyRadiance(const SkyOptions& options, const Vec3d& direction) {
  requireValid(options);
  if (direction.z < 0) return {};
  return options.zenith * relativeRadiance(options, direction.z, angleBetween(direction, sunDirection(options)));
}

Light skyLight(int order, const SkyOptions& options) {
  requireValid(options);
  Light light(order);
  SkySums sums = integrateSky(order, options);
  // From the sun's azimuth phi = 0 to where it stands: counter-clockwise from +x.
  const double azimuth = pi / 2 - radians(options.sunAzimuth);
  const sh::ZRotation turn(order, {std::cos(azimuth), std::sin(azimuth)});
  for (int l = 0; l < order; ++l) turn.apply(l, &sums.coefficients[sh::index(l, -l)]);

  // The ground sends back what it gets, evenly from below: albedo E / pi over the lower hemisphere.
  std::vector<double> ground(sums.coefficients.size());
  sh::rotateZonal(sh::zonalCap(order, pi / 2), {0, 0, -1}, ground);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    const double reflected = ground[i] * sums.irradiance / pi;
    const Vec3d& a = options.groundAlbedo;
    light.coefficients[i] = {options.zenith.x * (sums.coefficients[i] + a.x * reflected),
                             options.zenith.y * (sums.coefficients[i] + a.y * reflected),
                             options.zenith.z * (sums.coefficients[i] + a.z * reflected)};
  }
  return light;
}

Vec3d skyIrradiance(const SkyOptions& options) {
  requireValid(options);
  return options.zenith * integrateSky(1, options).irradiance;
}

}  // namespace shbake
