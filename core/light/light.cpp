// Operations on light in spherical harmonics: all linear, band by band.
#include "light/light.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "sh/check.h"
#include "sh/irradiance.h"
#include "sh/zyz_rotation.h"

namespace shbake {
namespace {

double& component(Vec3d& v, int c) {
  return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

Vec3d product(const Vec3d& a, const Vec3d& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// The sum of the coefficients times `weights`, of which there are as many.
Vec3d weightedSum(const Light& light, std::span<const double> weights) {
  Vec3d sum;
  for (std::size_t i = 0; i < light.coefficients.size(); ++i) sum += light.coefficients[i] * weights[i];
  return sum;
}

}  // namespace

Light::Light(int order_) : order(order_) {
  sh::requireOrder(order, 1, kMaxLightOrder, "a light");
  coefficients.assign(sh::coefficientCount(order), Vec3d{});
}

Light::Light(int order_, std::vector<Vec3d> values) : Light(order_) {
  if (values.size() != coefficients.size()) {
    throw usageError(
        "a light of order " + std::to_string(order) + " was given " + std::to_string(values.size()) + " coefficients",
        "give " + std::to_string(coefficients.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!isFinite(values[i])) {
      throw usageError("coefficient " + std::to_string(i) + " of a light is not finite", "give finite numbers");
    }
  }
  coefficients = std::move(values);
}

std::vector<double> Light::channel(int c) const {
  std::vector<double> values(coefficients.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    Vec3d v = coefficients[i];
    values[i] = component(v, c);
  }
  return values;
}

void Light::setChannel(int c, std::span<const double> values) {
  sh::requireCoefficients(order, values.size(), "a channel of a light");
  for (std::size_t i = 0; i < coefficients.size(); ++i) component(coefficients[i], c) = values[i];
}

void addLight(Light& sum, const Light& light, const Vec3d& weight) {
  if (light.order > sum.order) sum = withOrder(sum, light.order);
  for (std::size_t i = 0; i < light.coefficients.size(); ++i) {
    sum.coefficients[i] += product(weight, light.coefficients[i]);
  }
}

Light scaled(const Light& light, const Vec3d& factor) {
  Light result(light.order);
  addLight(result, light, factor);
  return result;
}

Light rotated(const Light& light, const sh::Matrix3d& rotation) {
  const sh::ZyzRotation turn(light.order);
  const sh::EulerZyz angles = sh::eulerZyz(rotation);
  Light result(light.order);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> values = light.channel(c);
    turn.apply(angles, values, values);
    result.setChannel(c, values);
  }
  return result;
}

Light mirrored(const Light& light, MirrorAxis axis) {
  Light result = light;
  for (int i = 0; i < sh::coefficientCount(light.order); ++i) {
    const int l = sh::degreeOf(i), m = sh::orderOf(i);
    // x -> -x turns phi into pi - phi, y -> -y into -phi: cosines (m >= 0) keep their sign under the second, sines
    // change it, and pi adds (-1)^m. z -> -z changes the Legendre function by (-1)^(l+m).
    const bool odd = m % 2 != 0;
    const bool negate = axis == MirrorAxis::z ? (l + m) % 2 != 0 : axis == MirrorAxis::y ? m < 0 : odd != (m < 0);
    if (negate) result.coefficients[i] = -result.coefficients[i];
  }
  return result;
}

Light withOrder(const Light& light, int order) {
  Light result(order);
  for (std::size_t i = 0; i < std::min(light.coefficients.size(), result.coefficients.size()); ++i) {
    result.coefficients[i] = light.coefficients[i];
  }
  return result;
}

double applyWindow(sh::Window window, std::span<Light> lights) {
  if (window == sh::Window::none || lights.empty()) return 0;
  const int order = lights.front().order;
  double lambda = 0;
  for (const Light& light : lights) {
    if (light.order != order) throw usageError("lights to be windowed together differ in order");
    for (int c = 0; c < 3 && window == sh::Window::automatic; ++c) {
      lambda = std::max(lambda, sh::automaticLambda(order, light.channel(c)));
    }
  }
  const std::vector<double> factors =
      window == sh::Window::automatic ? sh::laplacianFactors(lambda, order) : sh::windowFactors(window, order);
  for (Light& light : lights) {
    for (int i = 0; i < sh::coefficientCount(order); ++i) light.coefficients[i] *= factors[sh::degreeOf(i)];
  }
  return lambda;
}

Vec3d radianceFrom(const Light& light, const Vec3d& direction) {
  std::vector<double> y(light.coefficients.size());
  sh::evaluate(light.order, direction, y);
  return weightedSum(light, y);
}

Vec3d irradianceAt(const Light& light, const Vec3d& normal) {
  std::vector<double> y(light.coefficients.size());
  sh::evaluate(light.order, normal, y);
  for (int i = 0; i < sh::coefficientCount(light.order); ++i) y[i] *= sh::cosineLobe(sh::degreeOf(i));
  return weightedSum(light, y);
}

std::vector<Vec3d> bandEnergies(const Light& light) {
  std::vector<Vec3d> energies(light.order);
  for (int i = 0; i < sh::coefficientCount(light.order); ++i) {
    energies[sh::degreeOf(i)] += product(light.coefficients[i], light.coefficients[i]);
  }
  return energies;
}

std::vector<double> luminance(const Light& light) {
  std::vector<double> values;
  for (const Vec3d& c : light.coefficients) values.push_back(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
  return values;
}

Dominant dominantDirection(const Light& light) {
  const std::vector<double> c = luminance(light);
  if (light.order < 2 || c[0] == 0) return {};
  const Vec3d linear{c[sh::index(1, 1)], c[sh::index(1, -1)], c[sh::index(1, 0)]};
  // R_0 = c_00 / sqrt(4 pi), |R_1| = |c_1| / sqrt(12 pi).
  return {normalized(linear), length(linear) / (std::sqrt(3.0) * std::abs(c[0]))};
}

}  // namespace shbake
