// What the tests of this layer share: lights and images made by hand.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "light/environment_map.h"

namespace shbake::testing {

inline constexpr double kPi = std::numbers::pi;

/// Direction number `i`, uniform on the sphere.
inline Vec3d randomDirection(std::uint64_t seed, std::uint64_t i) {
  const double z = 2 * hashUnit(seed, 2 * i) - 1, phi = 2 * kPi * hashUnit(seed, 2 * i + 1), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Light randomLight(int order, std::uint64_t seed) {
  Light light(order);
  std::uint64_t i = 0;
  for (Vec3d& c : light.coefficients) {
    c = {2 * hashUnit(seed, i) - 1, 2 * hashUnit(seed, i + 1) - 1, 2 * hashUnit(seed, i + 2) - 1};
    i += 3;
  }
  return light;
}

/// The largest absolute difference of two lights' coefficients; infinite where the orders differ.
inline double maxDifference(const Light& a, const Light& b) {
  if (a.order != b.order) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < a.coefficients.size(); ++i) {
    const Vec3d d = a.coefficients[i] - b.coefficients[i];
    for (const double v : {d.x, d.y, d.z}) {
      if (!(std::abs(v) <= largest)) largest = std::abs(v);
    }
  }
  return largest;
}

/// The bits of all coefficients agree.
inline bool sameBits(const Light& a, const Light& b) {
  return a.order == b.order &&
         std::memcmp(a.coefficients.data(), b.coefficients.data(), a.coefficients.size() * sizeof(Vec3d)) == 0;
}

struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image(int w, int h, Rgb fill = {}) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}
  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

inline const std::vector<MapLayout>& allLayouts() {
  static const std::vector<MapLayout> all{
      MapLayout::latLong,         MapLayout::angular,       MapLayout::crossHorizontal, MapLayout::crossVertical,
      MapLayout::stripHorizontal, MapLayout::stripVertical, MapLayout::openexrCube};
  return all;
}

/// A black image of a layout whose unit (face, half the width of a lat-long map) has n pixels across.
inline Image blankImage(MapLayout layout, int n, Rgb fill = {}) {
  switch (layout) {
    case MapLayout::latLong:
      return {2 * n, n, fill};
    case MapLayout::angular:
      return {n, n, fill};
    case MapLayout::crossHorizontal:
      return {4 * n, 3 * n, fill};
    case MapLayout::crossVertical:
      return {3 * n, 4 * n, fill};
    case MapLayout::stripHorizontal:
      return {6 * n, n, fill};
    default:
      return {n, 6 * n, fill};
  }
}

/// Every pixel as k x k equal ones.
inline Image magnified(const Image& image, int k) {
  Image large(image.width * k, image.height * k);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) large.at(x, y) = image.at(x / k, y / k);
  }
  return large;
}

inline Image noiseImage(MapLayout layout, int n, std::uint64_t seed) {
  Image image = blankImage(layout, n);
  std::uint64_t i = 0;
  for (Rgb& p : image.pixels) {
    p = Rgb(static_cast<float>(hashUnit(seed, i)), static_cast<float>(hashUnit(seed, i + 1)),
            static_cast<float>(hashUnit(seed, i + 2)));
    i += 3;
  }
  return image;
}

inline EnvironmentMapLight projectImage(const Image& image, int order, MapLayout layout,
                                        EnvironmentMapOptions options = {}, int threads = 1) {
  options.layout = layout;
  Progress progress;
  return projectEnvironmentMap(mapInMemory(image.width, image.height, image.pixels), order, options, Parallel(threads),
                               progress);
}

/// A folder that is gone when the test ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "shbake-light-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) std::abort();
    path_ = pattern;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace shbake::testing
