// A light drawn as a lat-long map.
#include "view/light_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/lat_long_image.h"

namespace shbake {
namespace {

/// Even a slightly negative value is to be seen.
constexpr float kFaintest = 0.15f;

Rgb pixelOf(const Vec3d& radiance, const ToneMap& tone) {
  const Rgb light = displayLight(Rgb(radiance), tone);
  const double least = std::min({radiance.x, radiance.y, radiance.z});
  if (least >= 0) return light;
  const float depth = std::min(1.f, kFaintest + static_cast<float>(-least * std::exp2(tone.exposure)));
  return {depth, 0, depth};
}

}  // namespace

Picture lightPicture(const RadianceFunction& radiance, int height, const ToneMap& tone, const Parallel& parallel) {
  Picture picture(2 * height, height);
  parallel.forBlocks(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end, int) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < picture.width; ++x) {
        picture.at(x, y) = pixelOf(radiance(latLongDirection((x + 0.5) / picture.width, (y + 0.5) / height)), tone);
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
