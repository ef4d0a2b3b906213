// Environment maps in memory: every layout's orientation and weights.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "light/layout_places.h"
#include "sh/projection.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// The solid angle of the rectangle (0, 0)..(s, t) on the face of a cube of half width 1.
double faceCorner(double s, double t) {
  return std::atan2(s * t, std::sqrt(1 + s * s + t * t));
}

double angleBetweenDegrees(const Vec3d& a, const Vec3d& b) {
  return angleBetween(a, b) * 180 / kPi;
}

}  // namespace

TEST_CASE("a constant map of any layout and size is constant light") {
  for (const MapLayout layout : allLayouts()) {
    for (const int n : {4, 7, 33, 130}) {
      for (const int order : {1, 4, 9}) {
        INFO(layoutName(layout) << " " << n << " order " << order);
        const Light light = projectImage(blankImage(layout, n, {1, 0.5f, 3}), order, layout).light;
        Light expected(order);
        expected.coefficients[0] = std::sqrt(4 * kPi) * Vec3d{1, 0.5, 3};
        REQUIRE(maxDifference(light, expected) < 3e-12);
      }
    }
  }
}

TEST_CASE("a constant map keeps its exactness at order 32") {
  for (const MapLayout layout : {MapLayout::latLong, MapLayout::angular, MapLayout::stripVertical}) {
    Light expected(32);
    expected.coefficients[0] = Vec3d{1, 1, 1} * std::sqrt(4 * kPi);
    REQUIRE(maxDifference(projectImage(blankImage(layout, 24, {1, 1, 1}), 32, layout).light, expected) < 3e-12);
  }
}

TEST_CASE("a sun of one pixel is found in its direction in every layout") {
  const int n = 48;
  for (const MapLayout layout : allLayouts()) {
    for (int trial = 0; trial < 20; ++trial) {
      const Vec3d d = randomDirection(11, trial);
      Image image = blankImage(layout, n);
      const Place place = placeOf(layout, image, d);
      image.at(static_cast<int>(place.x), static_cast<int>(place.y)) = {100, 100, 100};
      const Dominant found = dominantDirection(projectImage(image, 4, layout).light);
      INFO(layoutName(layout) << " trial " << trial);
      // The pixel's centre of radiance lies within the pixel, so half a diagonal away or less: 180 / 48 * sqrt(2) / 2
      // degrees on lat-long maps, 360 / 48 * sqrt(2) / 2 on angular ones and 2 / 48 * sqrt(2) / 2 radians on cubes.
      REQUIRE(angleBetweenDegrees(found.direction, d) < (layout == MapLayout::angular ? 5.4 : 2.7));
      REQUIRE(found.ratio == Approx(1).margin(2e-3));
    }
  }
}

TEST_CASE("up y puts a map's top at +y, its centre at +x and its right at +z") {
  Image image = blankImage(MapLayout::latLong, 64);
  const auto sunAt = [&](double x, double y) {
    Image sun = image;
    sun.at(static_cast<int>(x), static_cast<int>(y)) = {1, 1, 1};
    EnvironmentMapOptions options;
    options.up = UpAxis::y;
    return dominantDirection(projectImage(sun, 3, MapLayout::latLong, options).light).direction;
  };
  REQUIRE(angleBetweenDegrees(sunAt(64, 0), {0, 1, 0}) < 2);
  REQUIRE(angleBetweenDegrees(sunAt(64, 31.5), {1, 0, 0}) < 2.1);
  REQUIRE(angleBetweenDegrees(sunAt(96, 31.5), {0, 0, 1}) < 2.1);
}

TEST_CASE("a mirrored map has left and right exchanged") {
  for (const MapLayout layout : allLayouts()) {
    Image image = blankImage(layout, 64);
    const Vec3d d = normalized(Vec3d{0.3, 0.8, 0.2}), twin{d.x, -d.y, d.z};
    const Place place = placeOf(layout, image, d);
    image.at(static_cast<int>(place.x), static_cast<int>(place.y)) = {1, 1, 1};
    EnvironmentMapOptions options;
    options.mirror = true;
    const Dominant found = dominantDirection(projectImage(image, 3, layout, options).light);
    REQUIRE(angleBetweenDegrees(found.direction, twin) < 4);
  }
}

TEST_CASE("pixels of lat-long maps have their exact solid angle") {
  for (const int n : {3, 8, 21}) {
    for (int y = 0; y < n; ++y) {
      Image image = blankImage(MapLayout::latLong, n);
      image.at(1, y) = {1, 1, 1};
      const double c0 = projectImage(image, 1, MapLayout::latLong).light.coefficients[0].x;
      const double exact = kPi / n * (std::cos(kPi * y / n) - std::cos(kPi * (y + 1) / n));
      REQUIRE(c0 * std::sqrt(4 * kPi) == Approx(exact).epsilon(1e-12));
    }
  }
}

TEST_CASE("pixels of cube maps have their exact solid angle") {
  const int n = 9;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      Image image = blankImage(MapLayout::stripHorizontal, n);
      image.at(2 * n + x, y) = {1, 1, 1};
      const double c0 = projectImage(image, 1, MapLayout::stripHorizontal).light.coefficients[0].x;
      const auto edge = [](int i) { return -1 + 2.0 * i / n; };
      const double exact = faceCorner(edge(x + 1), edge(y + 1)) - faceCorner(edge(x), edge(y + 1)) -
                           faceCorner(edge(x + 1), edge(y)) + faceCorner(edge(x), edge(y));
      REQUIRE(c0 * std::sqrt(4 * kPi) == Approx(exact).epsilon(1e-11));
    }
  }
}

TEST_CASE("pixels of angular maps have their exact solid angle in the ring around the centre") {
  // The four pixels at the centre form a square of half width h; by symmetry their moment of order 1 is four times the
  // integral of pi sin(pi r) / r over [0, h]^2, done here by 400 x 400 midpoints (error below (pi h / 400)^2 / 12).
  const int n = 8, steps = 400;
  Image image = blankImage(MapLayout::angular, n);
  for (const int y : {3, 4}) {
    for (const int x : {3, 4}) image.at(x, y) = {1, 1, 1};
  }
  const double h = 2.0 / n;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double r = std::hypot((i + 0.5) * h / steps, (j + 0.5) * h / steps);
      sum += kPi * std::sin(kPi * r) / r * (h / steps) * (h / steps);
    }
  }
  const double c0 = projectImage(image, 1, MapLayout::angular).light.coefficients[0].x;
  REQUIRE(c0 * std::sqrt(4 * kPi) == Approx(4 * sum).epsilon(1e-6));
}

TEST_CASE("outside the circle an angular map is not looked at") {
  Image image = blankImage(MapLayout::angular, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      // The nearest corner of the pixel to the centre is out of the circle.
      const double s = (std::abs(x - 31.5) - 0.5) / 32, t = (std::abs(y - 31.5) - 0.5) / 32;
      if (s * s + t * t >= 1) image.at(x, y) = {1000, 1000, 1000};
    }
  }
  REQUIRE(maxDifference(projectImage(image, 3, MapLayout::angular).light, Light(3)) == 0);
}

TEST_CASE("dividing pixels changes nothing: they are integrated, not sampled") {
  for (const MapLayout layout : allLayouts()) {
    for (const int order : {4, 9}) {
      const Image coarse = noiseImage(layout, 12, 5), fine = magnified(coarse, 11);
      const Light a = projectImage(coarse, order, layout).light, b = projectImage(fine, order, layout).light;
      INFO(layoutName(layout) << " order " << order);
      // Both are within 1e-12 of the integral of a radiance of up to 1 over 4 pi.
      REQUIRE(maxDifference(a, b) < 2e-11);
    }
  }
}

TEST_CASE("projections agree with random directions looked up in the image") {
  // The mean of 4 pi f y_i over uniform directions d, f being the pixel that placeOf() finds for d, is the coefficient;
  // its standard error comes from the same samples. With 7 * 48 comparisons, 5 standard errors are exceeded by chance
  // once in 5000 seeds.
  constexpr int kOrder = 4, kSamples = 60000;
  for (const MapLayout layout : allLayouts()) {
    const Image image = noiseImage(layout, 5, 17);
    const Light found = projectImage(image, kOrder, layout).light;
    std::vector<Vec3d> sums(kOrder * kOrder), squares(kOrder * kOrder);
    std::vector<double> y(kOrder * kOrder);
    for (int k = 0; k < kSamples; ++k) {
      const Vec3d d = randomDirection(18, k);
      const Place p = placeOf(layout, image, d);
      const Vec3d f(image.at(static_cast<int>(p.x), static_cast<int>(p.y)));
      sh::evaluate(kOrder, d, y);
      for (std::size_t i = 0; i < y.size(); ++i) {
        const Vec3d v = 4 * kPi * y[i] * f;
        sums[i] += v;
        squares[i] += {v.x * v.x, v.y * v.y, v.z * v.z};
      }
    }
    for (std::size_t i = 0; i < y.size(); ++i) {
      const auto check = [&](double sum, double square, double value) {
        const double mean = sum / kSamples, deviation = std::sqrt((square / kSamples - mean * mean) / kSamples);
        INFO(layoutName(layout) << " coefficient " << i);
        REQUIRE(std::abs(mean - value) < 5 * deviation);
      };
      check(sums[i].x, squares[i].x, found.coefficients[i].x);
      check(sums[i].y, squares[i].y, found.coefficients[i].y);
      check(sums[i].z, squares[i].z, found.coefficients[i].z);
    }
  }
}

TEST_CASE("threads change no bit") {
  for (const MapLayout layout : allLayouts()) {
    const Image image = noiseImage(layout, 96, 3);
    const Light one = projectImage(image, 5, layout, {}, 1).light;
    REQUIRE(sameBits(one, projectImage(image, 5, layout, {}, 2).light));
    REQUIRE(sameBits(one, projectImage(image, 5, layout, {}, 5).light));
  }
}

TEST_CASE("exposure multiplies by powers of two") {
  const Image image = noiseImage(MapLayout::latLong, 16, 4);
  EnvironmentMapOptions options;
  options.exposure = 3;
  const Light plain = projectImage(image, 3, MapLayout::latLong).light;
  REQUIRE(sameBits(scaled(plain, {8, 8, 8}), projectImage(image, 3, MapLayout::latLong, options).light));
}

TEST_CASE("bad pixels are counted and replaced by the stated rule") {
  const float inf = INFINITY, nan = NAN;
  Image image(16, 8, {1, 1, 1});
  image.at(5, 2) = {nan, 1, 1};
  image.at(6, 2) = {1, inf, 1};
  image.at(7, 3) = {1, 1, -2};
  image.at(8, 3) = {-inf, nan, -1};
  Image mended(16, 8, {1, 1, 1});
  mended.at(5, 2) = {};
  mended.at(6, 2) = {1, 0, 1};
  mended.at(7, 3) = {1, 1, 0};
  mended.at(8, 3) = {};

  const EnvironmentMapLight found = projectImage(image, 4, MapLayout::latLong);
  REQUIRE(found.badPixels.nan == 2);
  REQUIRE(found.badPixels.infinite == 1);
  REQUIRE(found.badPixels.negative == 1);
  REQUIRE(found.badPixels.total() == 4);
  REQUIRE(found.badPixels.x == 5);
  REQUIRE(found.badPixels.y == 2);
  REQUIRE(sameBits(found.light, projectImage(mended, 4, MapLayout::latLong).light));

  EnvironmentMapOptions keep;
  keep.keepNegative = true;
  mended.at(7, 3) = {1, 1, -2};
  const EnvironmentMapLight kept = projectImage(image, 4, MapLayout::latLong, keep);
  REQUIRE(kept.badPixels.negative == 1);
  REQUIRE(sameBits(kept.light, projectImage(mended, 4, MapLayout::latLong, keep).light));
}

TEST_CASE("shapes that fit no layout are refused by name") {
  const auto messageFor = [](int w, int h, MapLayout layout) -> std::string {
    try {
      projectImage(Image(w, h), 3, layout);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  REQUIRE_THAT(messageFor(10, 7, MapLayout::automatic),
               Catch::Contains("10x7 pixels") && Catch::Contains("name the layout"));
  REQUIRE_THAT(messageFor(10, 7, MapLayout::angular), Catch::Contains("square"));
  REQUIRE_THAT(messageFor(3, 3, MapLayout::angular), Catch::Contains("4 pixels"));
  REQUIRE_THAT(messageFor(10, 7, MapLayout::crossVertical), Catch::Contains("3:4"));
  REQUIRE_THAT(messageFor(12, 2, MapLayout::openexrCube), Catch::Contains("1:6"));
  REQUIRE(messageFor(10, 7, MapLayout::latLong).empty());
  REQUIRE_THROWS_AS(projectImage(Image(4, 2), 0, MapLayout::latLong), Error);
  REQUIRE_THROWS_AS(mapInMemory(4, 2, std::vector<Rgb>(7)), Error);
}

TEST_CASE("the layout is guessed from width : height") {
  const auto guess = [](int w, int h) { return projectImage(Image(w, h), 1, MapLayout::automatic); };
  REQUIRE(guess(8, 4).layout == MapLayout::latLong);
  REQUIRE(guess(8, 8).layout == MapLayout::angular);
  REQUIRE(guess(8, 6).layout == MapLayout::crossHorizontal);
  REQUIRE(guess(6, 8).layout == MapLayout::crossVertical);
  REQUIRE(guess(12, 2).layout == MapLayout::stripHorizontal);
  REQUIRE(guess(2, 12).layout == MapLayout::stripVertical);
  REQUIRE(guess(8, 4).layoutGuessed);
  REQUIRE_FALSE(projectImage(Image(8, 4), 1, MapLayout::latLong).layoutGuessed);
  for (const std::string& name : layoutNames()) REQUIRE(layoutName(*layoutNamed(name)) == name);
  REQUIRE_FALSE(layoutNamed("mercator"));
}

TEST_CASE("maps with pixels on their edge cover the sphere once") {
  const auto project = [](const Image& image, MapLayout layout, int order) {
    MapRows rows = mapInMemory(image.width, image.height, image.pixels);
    rows.border = true;
    EnvironmentMapOptions options;
    options.layout = layout;
    Progress progress;
    return projectEnvironmentMap(rows, order, options, Parallel(1), progress).light;
  };
  for (const MapLayout layout : {MapLayout::latLong, MapLayout::openexrCube}) {
    for (const int n : {2, 9, 64}) {
      Light expected(6);
      expected.coefficients[0] = std::sqrt(4 * kPi) * Vec3d{1, 2, 3};
      REQUIRE(maxDifference(project(blankImage(layout, n, {1, 2, 3}), layout, 6), expected) < 3e-12);
    }
  }
  // The first and the last column of a lat-long map are the same half circle at -x: half a cell each. The first row is
  // half a row at the pole.
  const int n = 32;
  const double step = 2 * kPi / (2 * n - 1), rise = kPi / (n - 1);
  for (const int x : {0, 2 * n - 1}) {
    Image image = blankImage(MapLayout::latLong, n);
    image.at(x, n / 2) = {1, 1, 1};
    const Light light = project(image, MapLayout::latLong, 3);
    const Vec3d d = dominantDirection(light).direction;
    REQUIRE(std::abs(d.y) < 1e-12);
    REQUIRE(d.x < -0.99);
    const double theta = (n / 2) * rise;
    const double area = step / 2 * (std::cos(theta - rise / 2) - std::cos(theta + rise / 2));
    REQUIRE(light.coefficients[0].x * std::sqrt(4 * kPi) == Approx(area).epsilon(1e-12));
  }
  Image top = blankImage(MapLayout::latLong, n);
  top.at(5, 0) = {1, 1, 1};
  REQUIRE(project(top, MapLayout::latLong, 1).coefficients[0].x * std::sqrt(4 * kPi) ==
          Approx(step * (1 - std::cos(rise / 2))).epsilon(1e-11));
  // A cube's corner pixel: a quarter of a cell, in the corner of the face.
  Image cube = blankImage(MapLayout::openexrCube, n);
  cube.at(0, 0) = {1, 1, 1};
  const double edge = 1 - 1.0 / (n - 1);
  const double corner = faceCorner(1, 1) - 2 * faceCorner(1, edge) + faceCorner(edge, edge);
  REQUIRE(project(cube, MapLayout::openexrCube, 1).coefficients[0].x * std::sqrt(4 * kPi) ==
          Approx(corner).epsilon(1e-9));
}
