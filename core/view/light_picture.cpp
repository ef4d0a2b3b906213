// A light drawn as a lat-long map.
#include "view/light_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace shbake {
namespace {

/// Even a slightly negative value is to be seen.
constexpr float kFaintest = 0.15f;

/// The direction that the place (u, v) of a lat-long map stands for, both 0..1 from its upper left corner.
Vec3d latLongDirection(double u, double v) {
  constexpr double kPi = std::numbers::pi;
  const double azimuth = 2 * kPi * (0.5 - u), polar = kPi * v;
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

Rgb pixelOf(const Vec3d& radiance, const ToneMap& tone) {
  const Rgb light = displayLight(Rgb(radiance), tone);
  const double least = std::min({radiance.x, radiance.y, radiance.z});
  if (least >= 0) return light;
  const float depth = std::min(1.f, kFaintest + static_cast<float>(-least * std::exp2(tone.exposure)));
  return {depth, 0, depth};
}

}  // namespace

Picture lightPicture(const RadianceFunction& radiance, int height, int samples, const ToneMap& tone,
                     const Parallel& parallel) {
  if (samples < 1 || samples > 16) throw usageError("the number of samples is out of range", "give 1 to 16");
  Picture picture(2 * height, height);
  const double columns = static_cast<double>(picture.width) * samples, rows = static_cast<double>(height) * samples;
  const float share = 1 / static_cast<float>(samples * samples);
  parallel.forBlocks(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end, int) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < picture.width; ++x) {
        Rgb sum;
        for (int j = y * samples; j < (y + 1) * samples; ++j) {
          for (int i = x * samples; i < (x + 1) * samples; ++i) {
            sum += pixelOf(radiance(latLongDirection((i + 0.5) / columns, (j + 0.5) / rows)), tone);
          }
        }
        picture.at(x, y) = sum * share;
      }
    }
  });
  return picture;
}

double automaticExposure(const Light& light) {
  const Vec3d mean = light.coefficients[0] * (0.5 * std::numbers::inv_sqrtpi);
  const double greatest = std::max({mean.x, mean.y, mean.z});
  return greatest > 0 ? std::log2(0.5 / greatest) : 0;
}

}  // namespace shbake
