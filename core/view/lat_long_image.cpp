// A lat-long environment map held in memory, to be looked up.
#include "view/lat_long_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shbake {
namespace {

constexpr double kPi = std::numbers::pi;

Rgb repaired(const Rgb& c) {
  const auto channel = [](float v) { return std::isfinite(v) && v > 0 ? v : 0.f; };
  return {channel(c.x), channel(c.y), channel(c.z)};
}

}  // namespace

Vec3d latLongDirection(double u, double v) {
  const double azimuth = 2 * kPi * (0.5 - u), polar = kPi * v;
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

std::optional<LatLongImage> LatLongImage::read(const std::string& path, PixelEncoding encoding, int threads) {
  const MapRows rows = openMapFile(path, encoding, threads);
  const std::optional<MapLayout> layout = rows.layout ? rows.layout : guessLayout(rows.width, rows.height);
  if (layout != MapLayout::latLong || rows.border) return std::nullopt;
  LatLongImage image;
  image.width_ = rows.width;
  image.height_ = rows.height;
  image.pixels_.resize(static_cast<std::size_t>(rows.width) * rows.height);
  rows.read(0, rows.height, image.pixels_);
  for (Rgb& c : image.pixels_) c = repaired(c);
  return image;
}

Rgb LatLongImage::from(const Vec3d& direction) const {
  const double u = 0.5 - std::atan2(direction.y, direction.x) / (2 * kPi);
  const double v = std::acos(std::clamp(direction.z, -1.0, 1.0)) / kPi;
  const double x = u * width_ - 0.5, y = std::clamp(v * height_ - 0.5, 0.0, height_ - 1.0);
  const int x0 = static_cast<int>(std::floor(x)), y0 = std::min(static_cast<int>(y), std::max(height_ - 2, 0));
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const auto pixel = [&](int px, int py) {
    const int wrapped = ((px % width_) + width_) % width_;
    return pixels_[static_cast<std::size_t>(std::min(py, height_ - 1)) * width_ + wrapped];
  };
  const Rgb above = pixel(x0, y0) * (1 - fx) + pixel(x0 + 1, y0) * fx;
  const Rgb below = pixel(x0, y0 + 1) * (1 - fx) + pixel(x0 + 1, y0 + 1) * fx;
  return above * (1 - fy) + below * fy;
}

}  // namespace shbake
