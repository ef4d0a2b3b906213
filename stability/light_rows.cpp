// Rows about light: probes at their edges, suns of one pixel, overflow, skies at the horizon.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/hash.h"
#include "stability/families.h"

namespace shbake::stability {
namespace {

using std::numbers::pi;
constexpr std::uint64_t kSeed = 97;

Vec3d randomDirection(std::uint64_t i) {
  const double z = 2 * hashUnit(kSeed, 2 * i) - 1, phi = 2 * pi * hashUnit(kSeed, 2 * i + 1);
  return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
}

// ---- Looking up an angular map ("light probe"): forward is +x, right -y, up +z.

constexpr int kProbe = 64;

/// A probe of radiance 2 + z; no pixel is asked for that lies beyond the rim.
std::vector<Rgb> paintedProbe() {
  std::vector<Rgb> pixels;
  for (int y = 0; y < kProbe; ++y) {
    for (int x = 0; x < kProbe; ++x) {
      const double u = (2 * x + 1.0) / kProbe - 1, v = 1 - (2 * y + 1.0) / kProbe, r = std::hypot(u, v);
      const auto value = static_cast<float>(2 + std::sin(pi * r) * v / r);
      pixels.emplace_back(value, value, value);
    }
  }
  return pixels;
}

/// Debevec's formula as it is commonly written: NaN straight ahead and behind, one pixel too far on the rim.
double printedLookUp(const std::vector<Rgb>& pixels, const Vec3d& d) {
  const double r = std::acos(d.x) / pi / std::sqrt(d.y * d.y + d.z * d.z);
  const double u = (1 - d.y * r) / 2 * kProbe, v = (1 - d.z * r) / 2 * kProbe;
  if (!(u >= 0 && u < kProbe && v >= 0 && v < kProbe)) return std::numeric_limits<double>::quiet_NaN();
  return pixels[static_cast<std::size_t>(v) * kProbe + static_cast<std::size_t>(u)].x;
}

Outcome measureProbeEdges(const Bench&) {
  const std::vector<Rgb> pixels = paintedProbe();
  EnvironmentMapOptions options;
  options.layout = MapLayout::angular;
  const MapImage map(mapInMemory(kProbe, kProbe, pixels), options);
  std::vector<Vec3d> directions;
  for (const double ahead : {1.0, -1.0}) {
    for (const double aside : {0.0, 1e-300, 1e-17, 1e-12, 1e-8, 1e-4}) {
      for (int k = 0; k < 8; ++k) {
        // Exactly on the axes of the image, too, where an index can reach the image's size.
        const double c = k % 4 == 0 ? 1 : k % 4 == 2 ? -1 : 0, s = k % 4 == 1 ? 1 : k % 4 == 3 ? -1 : 0;
        const double turn = k < 4 ? 0 : std::numbers::sqrt2 / 2;
        const Vec3d side = k < 4 ? Vec3d(0, c, s) : Vec3d(0, turn * (c - s), turn * (c + s));
        directions.push_back(side * aside + Vec3d(ahead * std::sqrt(1 - aside * aside), 0, 0));
      }
    }
  }
  for (std::uint64_t i = 0; i < 104; ++i) directions.push_back(randomDirection(i));
  Outcome outcome;
  for (const Vec3d& d : directions) {
    // A pixel spans 2 pi / kProbe of the angle; radiance changes by no more than that across it.
    const auto wrong = [&](double value) { return !(std::abs(value - (2 + d.z)) <= 2 * pi / kProbe); };
    outcome.naive.add(wrong(printedLookUp(pixels, d)));
    outcome.own.add(wrong(static_cast<double>(map.from(normalized(d)).x)));
  }
  return outcome;
}

// ---- Suns of one pixel.

Outcome measurePixelSuns(const Bench& bench) {
  Outcome outcome;
  constexpr int kSamples = 10000;
  for (const int height : {32, 128, bench.brief ? 128 : 512}) {
    const int width = 2 * height;
    for (int i = 0; i < (bench.brief ? 3 : 12); ++i) {
      const int y = i == 0 ? 0 : i == 1 ? height - 1 : static_cast<int>(hashUnit(kSeed, 500 + i) * height);
      const int x = i == 2 ? width - 1 : static_cast<int>(hashUnit(kSeed, 600 + i) * width);
      std::vector<Rgb> pixels(static_cast<std::size_t>(width) * height);
      pixels[static_cast<std::size_t>(y) * width + x] = {1e5f, 1e5f, 1e5f};
      EnvironmentMapOptions options;
      options.layout = MapLayout::latLong;
      const Light light =
          projectEnvironmentMap(mapInMemory(width, height, pixels), 3, options, bench.parallel, bench.progress).light;
      // Its solid angle times y_00.
      const double exact =
          1e5 * 2 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height)) / std::sqrt(4 * pi);
      int met = 0;
      for (int k = 0; k < kSamples; ++k) {
        const Vec3d d = randomDirection(static_cast<std::uint64_t>(i) * kSamples + k);
        const int row = std::min(height - 1, static_cast<int>(std::acos(d.z) / pi * height));
        const int column = std::min(width - 1, static_cast<int>((0.5 - std::atan2(d.y, d.x) / (2 * pi)) * width));
        met += row == y && column == x ? 1 : 0;
      }
      const double sampled = 1e5 * 4 * pi * met / kSamples / std::sqrt(4 * pi);
      const auto wrong = [&](double value) { return !(std::abs(value - exact) <= kNoticeable * exact); };
      outcome.naive.add(wrong(sampled));
      outcome.own.add(wrong(light.coefficients[0].x));
    }
  }
  return outcome;
}

// ---- Pixels that are no numbers.

Outcome measureOverflow(const Bench& bench) {
  constexpr int kWidth = 64, kHeight = 32;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Outcome outcome;
  for (int i = 0; i < (bench.brief ? 10 : 60); ++i) {
    std::vector<Rgb> pixels(kWidth * kHeight, Rgb(1, 1, 1));
    std::size_t bad = 0;
    for (int k = 0; k <= i % 5; ++k) {
      Rgb& pixel = pixels[static_cast<std::size_t>(hashUnit(kSeed, 700 + 5 * i + k) * kWidth * kHeight)];
      if (pixel != Rgb(1, 1, 1)) continue;
      pixel = i % 3 == 2 ? Rgb(1, std::numeric_limits<float>::quiet_NaN(), 1) : Rgb(kInfinity, kInfinity, 1);
      ++bad;
    }
    MapRows rows = mapInMemory(kWidth, kHeight, pixels);
    rows.mostFinite = 65504;  // what a file of half floats says
    EnvironmentMapOptions options;
    options.layout = MapLayout::latLong;
    const EnvironmentMapLight found = projectEnvironmentMap(rows, 2, options, bench.parallel, bench.progress);
    const Vec3d& mean = found.light.coefficients[0];
    // No pixel can take away from the others, and all of them together cannot exceed 65504.
    const bool isLight = isFinite(mean) && std::min({mean.x, mean.y, mean.z}) > 3 && mean.x < 65504 * 4;
    outcome.own.add(!isLight || found.badPixels.total() != bad);
    Vec3f sum;
    for (const Rgb& pixel : pixels) sum += pixel;
    outcome.naive.add(!isFinite(sum));
  }
  return outcome;
}

// ---- Skies.

/// The skies as Green's text prints them: the overcast one with the angle from the zenith, the partly cloudy one with
/// the sun's angle in the gradation, and nothing about the horizon.
double printedSky(const SkyOptions& options, const Vec3d& d) {
  const double theta = std::acos(d.z), sun = (90 - options.sunAltitude) * pi / 180;
  if (options.model == SkyModel::overcast) return (1 + 2 * std::sin(theta)) / 3;
  const double gamma = std::acos(dot(d, sunDirection(options)));
  if (options.model == SkyModel::clear) {
    const auto f = [](double g) { return 0.91 + 10 * std::exp(-3 * g) + 0.45 * std::cos(g) * std::cos(g); };
    return f(gamma) * (1 - std::exp(-0.32 / d.z)) / (f(sun) * (1 - std::exp(-0.32)));
  }
  const auto f = [](double g) { return 0.526 + 5 * std::exp(-1.5 * g); };
  return f(gamma) * (1 - std::exp(-0.8 / std::cos(gamma))) / (f(sun) * (1 - std::exp(-0.8)));
}

/// Skies are finite and not negative. None is brighter than the clear one around a sun on the horizon, 41.5 zeniths:
/// (0.91 + 10 + 0.45) / (0.91 + 10 exp(-3 pi / 2)) / (1 - exp(-0.32)). The zenith has the radiance that was asked for,
/// and what is below the horizon none.
bool isNoSky(double value, const Vec3d& d) {
  if (!std::isfinite(value) || value < 0 || value > 42) return true;
  if (d.z < 0) return value != 0;
  return d.z == 1 && std::abs(value - 1) > 1e-12;
}

Outcome measureSkies(const Bench&) {
  Outcome outcome;
  for (const SkyModel model : {SkyModel::overcast, SkyModel::clear, SkyModel::partlyCloudy}) {
    for (const double altitude : {0.0, 1e-12, 0.5, 45.0, 90.0}) {
      SkyOptions options;
      options.model = model;
      options.sunAltitude = altitude;
      for (const double z : {1.0, 0.5, 1e-3, 1e-12, 1e-300, 0.0, -0.0, -1e-300, -1e-12, -0.5, -1.0}) {
        for (int k = 0; k < 4; ++k) {
          const double r = std::sqrt((1 - z) * (1 + z)), phi = pi / 2 * k;
          const Vec3d d{r * std::round(std::sin(phi)), r * std::round(std::cos(phi)), z};
          outcome.own.add(isNoSky(skyRadiance(options, d).x, d));
          outcome.naive.add(isNoSky(printedSky(options, d), d));
        }
      }
      const Light light = skyLight(4, options);
      for (const Vec3d& c : light.coefficients) outcome.own.add(!isFinite(c));
    }
  }
  return outcome;
}

constexpr Row kRows[] = {
    {"probe-edges", "light", "probes straight ahead, behind and on the rim", "NaN that spreads over the picture",
     "the usual formula and an index by truncation", "limits at the poles, neighbours over the rim",
     "--background light", "a direction fails when its radiance is off by more than a pixel's step", 0,
     measureProbeEdges},
    {"pixel-suns", "light", "suns of one pixel", "a scene without its sun, or with ten of them",
     "10,000 random directions", "every pixel integrated over its patch of the sphere", "light FILE",
     "a sun fails when its mean is off by 2 %", 0, measurePixelSuns},
    {"overflow", "light", "pixels beyond the largest half float", "a black or white picture", "summed as they are",
     "counted, named, and taken as the largest number or as black", "light FILE, which lists them",
     "a map fails when its light is not finite or the pixels are not counted", 0, measureOverflow},
    {"sky-horizon", "light", "CIE skies at the horizon and with the sun there",
     "a glaring or negative line at the horizon", "the formulas as they are printed",
     "the formulas of the standard, limits at the horizon, black below", "light --sky",
     "a direction fails when its radiance is not finite, negative, above 42 zeniths, not 1 at the zenith, or "
     "not 0 below the horizon; a coefficient when it is not finite",
     0, measureSkies},
};

}  // namespace

std::span<const Row> lightRows() {
  return kRows;
}

}  // namespace shbake::stability
