// Environment maps looked up by direction, in every layout and orientation.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "light/layout_places.h"
#include "light/map_image.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

MapRows rowsOf(const Image& image) {
  return mapInMemory(image.width, image.height, image.pixels);
}

MapImage lookUp(const Image& image, MapLayout layout, EnvironmentMapOptions options = {}) {
  options.layout = layout;
  return MapImage(rowsOf(image), options);
}

/// Changes by at most 3 a radian.
Rgb smoothRadiance(const Vec3d& d) {
  return Rgb(Vec3d{2 + d.x + 0.5 * d.y * d.z, 2 + d.y - 0.3 * d.x * d.x, 2 + d.z + 0.2 * d.x * d.y * d.z});
}

/// A map whose pixels hold the mean of smoothRadiance() over directions that fall into them. Pixels that none falls
/// into are far too bright: they are not to be used.
Image smoothImage(MapLayout layout, int n) {
  Image image = blankImage(layout, n);
  std::vector<float> counts(image.pixels.size());
  for (int i = 0; i < 400000; ++i) {
    const Vec3d d = randomDirection(31, i);
    const Place p = placeOf(layout, image, d);
    const int x = std::min(static_cast<int>(p.x), image.width - 1),
              y = std::min(static_cast<int>(p.y), image.height - 1);
    image.at(x, y) += smoothRadiance(d);
    ++counts[static_cast<std::size_t>(y * image.width + x)];
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    image.pixels[i] = counts[i] > 0 ? image.pixels[i] * (1 / counts[i]) : Rgb(1e6f, 1e6f, 1e6f);
  }
  return image;
}

float largestDifference(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

}  // namespace

TEST_CASE("a direction sees the pixels around its place, in every layout") {
  const int n = 16;
  for (const MapLayout layout : allLayouts()) {
    const Image image = noiseImage(layout, n, 41);
    const MapImage map = lookUp(image, layout);
    int compared = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3d d = randomDirection(42, i);
      const Place p = placeOf(layout, image, d);
      const int x = static_cast<int>(std::floor(p.x - 0.5)), y = static_cast<int>(std::floor(p.y - 0.5));
      const bool wraps = layout == MapLayout::latLong || layout == MapLayout::angular;
      const int unit = wraps ? image.width : n, unitDown = wraps ? image.height : n;
      // Neighbours on other faces, beyond the edge or outside of the circle are the next test's.
      if (x < 0 || y < 0 || x / unit != (x + 1) / unit || y / unitDown != (y + 1) / unitDown) continue;
      if (layout == MapLayout::angular && std::hypot(x - 7, y - 7) > 6.5) continue;
      const auto fx = static_cast<float>(p.x - 0.5 - x), fy = static_cast<float>(p.y - 0.5 - y);
      const Rgb expected = image.at(x, y) * (1 - fx) * (1 - fy) + image.at(x + 1, y) * fx * (1 - fy) +
                           image.at(x, y + 1) * (1 - fx) * fy + image.at(x + 1, y + 1) * fx * fy;
      INFO(layoutName(layout) << " direction " << i);
      REQUIRE(largestDifference(map.from(d), expected) < 1e-5f);
      ++compared;
    }
    CHECK(compared > 2000);
  }
}

TEST_CASE("across faces, poles and rims no pixel of elsewhere is seen") {
  const int n = 20;
  for (const MapLayout layout : allLayouts()) {
    const Image image = smoothImage(layout, n);
    const MapImage map = lookUp(image, layout);
    // All pixels used lie within two diagonals of the direction: 2 sqrt 2 times pi / n on lat-long maps, 2 pi / n on
    // angular ones and 2 / n on cubes.
    const double pixel = layout == MapLayout::latLong ? kPi / n : layout == MapLayout::angular ? 2 * kPi / n : 2.0 / n;
    const auto most = static_cast<float>(3 * 2 * std::numbers::sqrt2 * pixel);
    for (int i = 0; i < 20000; ++i) {
      const Vec3d d = randomDirection(43, i);
      INFO(layoutName(layout) << " direction " << d.x << " " << d.y << " " << d.z);
      REQUIRE(largestDifference(map.from(d), smoothRadiance(d)) < most);
    }
    for (const Vec3d& d : {Vec3d{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, normalized(Vec3d{-1, 1, 1})}) {
      REQUIRE(largestDifference(map.from(d), smoothRadiance(d)) < most);
    }
  }
}

TEST_CASE("orientation, exposure and bad pixels count as for the light of a map") {
  for (const MapLayout layout : allLayouts()) {
    Image image = noiseImage(layout, 8, 44);
    image.pixels[image.pixels.size() / 2] = {NAN, 1, -3};
    EnvironmentMapOptions options;
    const MapImage plain = lookUp(image, layout);
    options.mirror = true;
    const MapImage mirrored = lookUp(image, layout, options);
    options.up = UpAxis::y;
    options.exposure = 3;
    const MapImage turned = lookUp(image, layout, options);
    for (int i = 0; i < 500; ++i) {
      const Vec3d d = randomDirection(45, i), twin{d.x, -d.y, d.z};
      REQUIRE(mirrored.from(twin) == plain.from(d));
      REQUIRE(largestDifference(turned.from(axesFor(UpAxis::y) * twin), plain.from(d) * 8.f) < 1e-4f);
      REQUIRE((plain.from(d).x >= 0 && plain.from(d).z >= 0));
    }
  }
  Image negative(4, 2, {-1, 2, 1});
  EnvironmentMapOptions keep;
  keep.keepNegative = true;
  CHECK(lookUp(negative, MapLayout::latLong).from({1, 0, 0}) == Rgb(0, 2, 1));
  CHECK(lookUp(negative, MapLayout::latLong, keep).from({1, 0, 0}) == Rgb(-1, 2, 1));
}

TEST_CASE("pixels on the edge of a map are met at its edge") {
  const int n = 9, width = 2 * n;
  Image image(width, n);
  const auto direction = [&](int x, int y) {
    const double theta = kPi * y / (n - 1), phi = kPi * (1 - 2.0 * x / (width - 1));
    return Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
  };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = smoothRadiance(direction(x, y));
  }
  MapRows rows = rowsOf(image);
  rows.border = true;
  const MapImage map(rows, {});
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < width; ++x) {
      INFO(x << " " << y);
      REQUIRE(largestDifference(map.from(direction(x, y)), image.at(x, y)) < 1e-5f);
    }
  }
}

TEST_CASE("large images are averaged while they are read") {
  const int width = 8192, height = 4096;
  MapRows rows;
  rows.name = "large";
  rows.width = width;
  rows.height = height;
  rows.rowStep = 7;
  rows.read = [](int begin, int end, std::span<Rgb> out) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < width; ++x) {
        out[static_cast<std::size_t>(y - begin) * width + x] = {x % 2 == 0 ? 0.f : 1.f, y % 2 == 0 ? 0.f : 1.f, 2};
      }
    }
  };
  const MapImage map(rows, {});
  CHECK((map.width() == width / 2 && map.height() == height / 2));
  for (int i = 0; i < 100; ++i) REQUIRE(map.from(randomDirection(46, i)) == Rgb(0.5f, 0.5f, 2));
}

TEST_CASE("an image that does not fit its layout is refused by name") {
  using Catch::Contains;
  REQUIRE_THROWS_WITH(lookUp(Image(10, 7), MapLayout::angular), Contains("image") && Contains("square"));
  REQUIRE_THROWS_WITH(lookUp(Image(10, 7), MapLayout::automatic), Contains("image") && Contains("name the layout"));
  REQUIRE_THROWS_AS(MapImage::read("/nowhere/map.hdr", {}, 1), Error);
}
