// Incident light as spherical-harmonic coefficients, and what can be done with it.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.h"
#include "sh/basis.h"
#include "sh/matrix3.h"
#include "sh/window.h"
#include "sh/z_rotation.h"

namespace shbake {

/// The highest order of a light.
inline constexpr int kMaxLightOrder = sh::kMaxTurnOrder;

/// Radiance arriving from all directions, a direction pointing towards the light. Each coefficient is a linear RGB
/// triple (x red, y green, z blue), in the real orthonormal basis without Condon-Shortley phase, index l(l+1)+m. What
/// has order n holds n^2 coefficients; those of higher degrees are taken as zero.
struct Light {
  int order = 1;
  std::vector<Vec3d> coefficients = std::vector<Vec3d>(1);

  Light() = default;
  /// A black light. Throws a usage error unless 1 <= order <= kMaxLightOrder.
  explicit Light(int order);
  /// Throws a usage error when the coefficients are not order^2 finite triples.
  Light(int order, std::vector<Vec3d> coefficients);

  /// The order^2 coefficients of channel 0 (red), 1 or 2.
  std::vector<double> channel(int c) const;
  void setChannel(int c, std::span<const double> values);
};

/// A direction for a mirror: the axis whose sign changes.
enum class MirrorAxis { x, y, z };

/// Adds `weight` * `light` to `sum`, channel by channel; the higher order of the two remains.
void addLight(Light& sum, const Light& light, const Vec3d& weight = {1, 1, 1});

/// The light times a factor a channel.
Light scaled(const Light& light, const Vec3d& factor);

/// The light turned by a rotation matrix: what shone from d shines from R d. Throws a usage error for a matrix that is
/// not a rotation (sh::nearestRotation()).
Light rotated(const Light& light, const sh::Matrix3d& rotation);

/// The light seen in a mirror: what shone from (x, y, z) shines from (-x, y, z), and so on.
Light mirrored(const Light& light, MirrorAxis axis);

/// The light with bands dropped, or with zero bands added.
Light withOrder(const Light& light, int order);

/// Damps the bands of lights of one order by the same factors in all channels; for Window::automatic by the least
/// window that leaves none of them negative. Returns its lambda, else 0. Throws a usage error where no window can
/// (sh::automaticLambda()) and when the orders differ.
double applyWindow(sh::Window window, std::span<Light> lights);

/// Radiance from a direction of unit length, as far as the bands give it: ringing can make it negative.
Vec3d radianceFrom(const Light& light, const Vec3d& direction);

/// Irradiance (pi times the radiance of an open diffuse surface of albedo 1) at a surface with this unit normal.
Vec3d irradianceAt(const Light& light, const Vec3d& normal);

/// The squares of each band's coefficients, summed over its orders: order() values a channel.
std::vector<Vec3d> bandEnergies(const Light& light);

/// One channel that stands for the light where one is needed: luminance with the weights of Rec. 709 (0.2126, 0.7152,
/// 0.0722).
std::vector<double> luminance(const Light& light);

/// The direction that the linear band of the luminance points to, and how directed the light is.
struct Dominant {
  Vec3d direction;   ///< unit length; zero where the band is zero
  double ratio = 0;  ///< |R_1| / R_0 of Hazel's normalised form: 0 for even light, 1 for light from one direction; 0
                     ///< for black light. Above 1 the light must be negative somewhere.
};
Dominant dominantDirection(const Light& light);

}  // namespace shbake
