// Skies of the CIE as light.
#pragma once

#include <optional>
#include <string>

#include "light/light.h"

namespace shbake {

/// The three standard skies of 1955 to 1973.
enum class SkyModel {
  overcast,      ///< Moon and Spencer: L = Lz (1 + 2 sin elevation) / 3
  clear,         ///< Kittler: brightest around the sun and towards the horizon
  partlyCloudy,  ///< the intermediate sky between them
};

/// "overcast", "clear", "partly-cloudy".
const char* skyName(SkyModel model);
std::optional<SkyModel> skyNamed(const std::string& name);

struct SkyOptions {
  SkyModel model = SkyModel::overcast;
  Vec3d zenith{1, 1, 1};    ///< radiance at the zenith, 0 or more a channel
  double sunAltitude = 45;  ///< degrees above the horizon, 0..90; not used by the overcast sky
  double sunAzimuth = 0;    ///< degrees clockwise from north, seen from above: 0 = north = +y, 90 = east = +x
  Vec3d groundAlbedo{};     ///< 0..1 a channel: below the horizon the ground reflects the sky evenly; 0 leaves it black
};

/// Unit vector towards the sun, +z up.
Vec3d sunDirection(const SkyOptions& options);

/// Radiance of the sky from a direction of unit length: the sky alone, 0 on the horizon's lower side. The sun's own
/// disc is not part of it. At the horizon itself (z = 0) it is the limit from above.
Vec3d skyRadiance(const SkyOptions& options, const Vec3d& direction);

/// The sky as light of the stated order, the ground below the horizon. Only the upper hemisphere is integrated, so that
/// the edge at the horizon costs nothing; each coefficient is within kSkyError of the sky's integral. Throws a usage
/// error for options out of range.
Light skyLight(int order, const SkyOptions& options);

/// Error of a sky's coefficients, relative to the integral of its radiance.
inline constexpr double kSkyError = 1e-9;

/// Irradiance of a horizontal surface under the open sky, to kSkyError: 7 pi / 9 of the zenith's radiance for the
/// overcast one.
Vec3d skyIrradiance(const SkyOptions& options);

}  // namespace shbake
