// Environment maps from files.
#include <OpenImageIO/imageio.h>

#include <array>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/memory.h"
#include "base/srgb.h"
#include "light/support.h"
#include "sh/zyz_rotation.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

struct FileKind {
  const char* extension;
  OIIO::TypeDesc type;
  int tile = 0;
  const char* compression = "";
};

OIIO::ImageSpec specFor(const Image& image, const FileKind& kind) {
  OIIO::ImageSpec spec(image.width, image.height, 3, kind.type);
  spec.tile_width = spec.tile_height = kind.tile;
  if (*kind.compression) spec.attribute("compression", kind.compression);
  return spec;
}

void writeImage(const std::string& path, const Image& image, const OIIO::ImageSpec& spec) {
  const auto out = OIIO::ImageOutput::create(path);
  REQUIRE(out);
  REQUIRE(out->open(path, spec));
  REQUIRE(out->write_image(OIIO::TypeFloat, image.pixels.data()));
  REQUIRE(out->close());
}

EnvironmentMapLight projectFile(const std::string& path, int order, const EnvironmentMapOptions& options = {},
                                int threads = 1) {
  Progress progress;
  return projectEnvironmentMap(path, order, options, Parallel(threads), progress);
}

std::string messageFor(const std::string& path, const EnvironmentMapOptions& options = {}) {
  try {
    projectFile(path, 3, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Noise of values that RGBE, half and 8-bit files hold exactly: k / 128 with the same exponent in all channels.
Image exactNoise(int width, int height) {
  Image image(width, height);
  std::uint64_t i = 0;
  for (Rgb& p : image.pixels) {
    const auto value = [&] { return static_cast<float>(128 + hashBits(9, i++) % 128) / 128; };
    p.x = value();
    p.y = value();
    p.z = value();
  }
  return image;
}

const std::string kProbes = std::string(SHBAKE_SHARED_DIR) + "/probes/";

bool missing(const std::string& path) {
  if (std::filesystem::exists(path)) return false;
  WARN("skipped: " << path << " is not there");
  return true;
}

/// All pixels of a file, by OpenImageIO alone.
Image readWhole(const std::string& path) {
  const auto in = OIIO::ImageInput::open(path);
  REQUIRE(in);
  Image image(in->spec().width, in->spec().height);
  REQUIRE(in->read_image(0, 0, 0, 3, OIIO::TypeFloat, image.pixels.data()));
  return image;
}

/// A lat-long image by steps x steps midpoints a pixel, direction by direction.
Light bySubpixels(const Image& image, int order, int steps) {
  Light light(order);
  std::vector<double> y(light.coefficients.size());
  const double height = kPi / image.height / steps, width = 2 * kPi / image.width / steps;
  for (int row = 0; row < image.height * steps; ++row) {
    const double theta = (row + 0.5) * height, s = std::sin(theta);
    for (int column = 0; column < image.width * steps; ++column) {
      const double phi = kPi - (column + 0.5) * width;
      sh::evaluate(order, Vec3d{s * std::cos(phi), s * std::sin(phi), std::cos(theta)}, y);
      const Vec3d value = Vec3d(image.at(column / steps, row / steps)) * (s * height * width);
      for (std::size_t i = 0; i < y.size(); ++i) light.coefficients[i] += value * y[i];
    }
  }
  return light;
}

}  // namespace

TEST_CASE("files of every kind give the light of their pixels") {
  const Image image = exactNoise(64, 32);
  const TemporaryFolder folder;
  const Light expected = projectImage(image, 5, MapLayout::latLong).light;
  for (const FileKind& kind : std::vector<FileKind>{{"hdr", OIIO::TypeFloat},
                                                    {"exr", OIIO::TypeHalf, 0, "zip"},
                                                    {"exr", OIIO::TypeFloat, 0, "piz"},
                                                    {"exr", OIIO::TypeHalf, 16, "zip"},
                                                    {"exr", OIIO::TypeFloat, 48, "none"},
                                                    {"tif", OIIO::TypeFloat}}) {
    const std::string path = folder / (std::string("map.") + kind.extension);
    writeImage(path, image, specFor(image, kind));
    INFO(kind.extension << " " << kind.type.c_str() << " tile " << kind.tile);
    const EnvironmentMapLight found = projectFile(path, 5);
    REQUIRE(sameBits(found.light, expected));
    REQUIRE(found.layout == MapLayout::latLong);
    REQUIRE(found.width == 64);
    REQUIRE(sameBits(projectFile(path, 5, {}, 2).light, expected));
  }
}

TEST_CASE("every layout goes through files") {
  const TemporaryFolder folder;
  for (const MapLayout layout : allLayouts()) {
    const Image image = noiseImage(layout, 40, 12);
    const std::string path = folder / "map.exr";
    writeImage(path, image, specFor(image, {"exr", OIIO::TypeFloat, 32, "zip"}));
    EnvironmentMapOptions options;
    options.layout = layout;
    REQUIRE(sameBits(projectFile(path, 4, options).light, projectImage(image, 4, layout).light));
  }
}

TEST_CASE("8-bit images are decoded from sRGB unless they are said to be linear") {
  const TemporaryFolder folder;
  const std::string path = folder / "map.png";
  const float byte = 100 / 255.0f;
  const Image image(32, 16, {byte, byte, byte});
  writeImage(path, image, specFor(image, {"png", OIIO::TypeUInt8}));
  const double mean = std::sqrt(4 * kPi);
  REQUIRE(projectFile(path, 2).light.coefficients[0].x == Approx(mean * srgbToLinear(byte)).epsilon(1e-6));
  REQUIRE(projectFile(path, 2).notes.size() == 2);
  EnvironmentMapOptions options;
  options.encoding = PixelEncoding::linear;
  REQUIRE(projectFile(path, 2, options).light.coefficients[0].x == Approx(mean * byte).epsilon(1e-6));
}

TEST_CASE("grey images are grey light, alpha is ignored") {
  const TemporaryFolder folder;
  const std::string path = folder / "map.exr";
  const std::vector<float> grey(32 * 16, 0.25f);
  OIIO::ImageSpec spec(32, 16, 1, OIIO::TypeHalf);
  spec.channelnames = {"Y"};
  auto out = OIIO::ImageOutput::create(path);
  REQUIRE((out->open(path, spec) && out->write_image(OIIO::TypeFloat, grey.data()) && out->close()));
  const Vec3d c = projectFile(path, 1).light.coefficients[0];
  REQUIRE(c.x == Approx(0.25 * std::sqrt(4 * kPi)).epsilon(1e-12));
  REQUIRE((c.y == c.x && c.z == c.x));

  std::vector<float> rgba;
  for (int i = 0; i < 32 * 16; ++i) rgba.insert(rgba.end(), {1, 2, 3, 0.5f});
  out = OIIO::ImageOutput::create(path);
  REQUIRE((out->open(path, OIIO::ImageSpec(32, 16, 4, OIIO::TypeHalf)) &&
           out->write_image(OIIO::TypeFloat, rgba.data()) && out->close()));
  REQUIRE(length(projectFile(path, 1).light.coefficients[0] - Vec3d{1, 2, 3} * std::sqrt(4 * kPi)) < 1e-12);
}

TEST_CASE("infinite half floats count as the largest half float") {
  const TemporaryFolder folder;
  const std::string path = folder / "map.exr";
  Image image(32, 16), most(32, 16);
  image.at(3, 5) = {INFINITY, 1, 1};
  most.at(3, 5) = {65504, 1, 1};
  writeImage(path, image, specFor(image, {"exr", OIIO::TypeHalf}));
  const EnvironmentMapLight found = projectFile(path, 3);
  REQUIRE(found.badPixels.infinite == 1);
  REQUIRE((found.badPixels.x == 3 && found.badPixels.y == 5));
  REQUIRE(sameBits(found.light, projectImage(most, 3, MapLayout::latLong).light));
}

TEST_CASE("files that cannot be read are told in one line") {
  using Catch::Contains;
  const TemporaryFolder folder;
  REQUIRE_THAT(messageFor(folder / "none.hdr"), Contains("none.hdr: there is no such file"));
  REQUIRE_THAT(messageFor(folder / "."), Contains("is a folder"));
  std::FILE* file = std::fopen((folder / "empty.hdr").c_str(), "wb");
  std::fclose(file);
  REQUIRE_THAT(messageFor(folder / "empty.hdr"), Contains("is empty"));
  file = std::fopen((folder / "text.hdr").c_str(), "wb");
  std::fputs("not an image", file);
  std::fclose(file);
  REQUIRE_THAT(messageFor(folder / "text.hdr"), Contains("text.hdr: ") && !Contains("\n"));
  const Image wide(50, 7);
  writeImage(folder / "wide.hdr", wide, specFor(wide, {"hdr", OIIO::TypeFloat}));
  REQUIRE_THAT(messageFor(folder / "wide.hdr"), Contains("wide.hdr: 50x7 pixels"));
}

TEST_CASE("files that are cut off are refused at every length") {
  const Image image = exactNoise(64, 32);
  const TemporaryFolder folder;
  for (const FileKind& kind : std::vector<FileKind>{{"hdr", OIIO::TypeFloat}, {"exr", OIIO::TypeHalf, 0, "zip"}}) {
    const std::string path = folder / (std::string("map.") + kind.extension);
    writeImage(path, image, specFor(image, kind));
    const auto whole = std::filesystem::file_size(path);
    for (int part = 1; part < 16; ++part) {
      std::filesystem::resize_file(path, whole * (16 - part) / 16);
      const std::string message = messageFor(path);
      INFO(kind.extension << " cut to " << 16 - part << "/16");
      REQUIRE_FALSE(message.empty());
      REQUIRE(message.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("work on a map can be stopped") {
  const Image image(64, 32);
  Progress progress([](const ProgressState&) { return false; });
  try {
    projectEnvironmentMap(mapInMemory(64, 32, image.pixels), 3, {}, Parallel(1), progress);
    FAIL("was not stopped");
  } catch (const Error& error) {
    REQUIRE(error.kind() == ErrorKind::cancelled);
  }
}

TEST_CASE("memory does not grow with the map") {
  // Rows made on demand stand for a file. 4k x 2k pixels fill a dozen chunks; 8k x 4k whole would be 400 MB.
  const auto project = [](int height) {
    MapRows rows;
    rows.name = "made on demand";
    rows.width = 2 * height;
    rows.height = height;
    rows.read = [](int, int, std::span<Rgb> out) { std::fill(out.begin(), out.end(), Rgb{1, 1, 1}); };
    Progress progress;
    return projectEnvironmentMap(rows, 2, {}, Parallel(2), progress).light;
  };
  project(2048);
  const std::size_t before = peakMemory();
  const Light large = project(4096);
  REQUIRE(large.coefficients[0].x == Approx(std::sqrt(4 * kPi)).epsilon(1e-12));
  // Chunks are the same 8 MB; a few longer rows and tables of cosines come to less than this.
  REQUIRE(peakMemory() - before < std::size_t(16) << 20);
}

TEST_CASE("a real lat-long probe agrees with a brute-force sum") {
  for (const char* name : {"probulator_pisa.hdr", "probulator_uffizi.hdr"}) {
    if (missing(kProbes + name)) return;
    const int order = 4, steps = 4;
    const Light found = projectFile(kProbes + name, order).light;
    const Light reference = bySubpixels(readWhole(kProbes + name), order, steps);
    // A midpoint in a cell of width h errs by h^2 / 24 times the second derivative in each of two angles: of y_lm sin t
    // at most (order^2) times its largest value, about 0.75 at this order, weighted by the mean radiance.
    const double h = kPi / 128 / steps, mean = found.coefficients[0].x * std::sqrt(4 * kPi);
    REQUIRE(maxDifference(found, reference) < 2 * h * h / 24 * order * order * 0.75 * mean);
  }
}

TEST_CASE("a real probe of 1024 x 512 agrees with sums over its pixels' centres") {
  const std::string path = kProbes + "potsdamer_platz_1k.hdr";
  if (missing(path)) return;
  const EnvironmentMapLight found = projectFile(path, 4, {}, 2);
  const Light reference = bySubpixels(readWhole(path), 4, 1);
  const Vec3d& c = found.light.coefficients[0];
  const double h = kPi / 512, mean = std::max({c.x, c.y, c.z}) * std::sqrt(4 * kPi);
  REQUIRE(maxDifference(found.light, reference) < 2 * h * h / 24 * 16 * 0.75 * mean);
  REQUIRE(found.badPixels.total() == 0);
  // An outdoor place: brighter above than below.
  REQUIRE(dominantDirection(found.light).direction.z > 0);
}

TEST_CASE("OpenEXR's orientation images agree with each other") {
  // The same world as a lat-long map and as a cube, both by OpenEXR's definition with pixels on the edges. The images
  // show lines along the axes and are not alike on any two faces.
  const std::string latLong = kProbes + "openexr_OrientationLatLong.exr",
                    cube = kProbes + "openexr_OrientationCube.exr";
  if (missing(latLong) || missing(cube)) return;
  const EnvironmentMapLight a = projectFile(latLong, 12), b = projectFile(cube, 12);
  REQUIRE(a.layout == MapLayout::latLong);
  REQUIRE(b.layout == MapLayout::openexrCube);
  REQUIRE_FALSE(b.layoutGuessed);
  const double same = maxDifference(a.light, b.light);
  // Turned or mirrored in any other of the 48 ways, the cube is more than twice as far from the lat-long map as the two
  // images are apart by their own sampling.
  const std::array<Vec3d, 6> axes{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  int others = 0;
  for (const Light& cubeLight : {b.light, mirrored(b.light, MirrorAxis::x)}) {
    for (const Vec3d& x : axes) {
      for (const Vec3d& y : axes) {
        if (dot(x, y) != 0) continue;
        const Vec3d z = cross(x, y);
        const sh::Matrix3d turn{{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}};
        const double apart = maxDifference(a.light, rotated(cubeLight, turn));
        if (apart < same * (1 + 1e-9)) continue;
        ++others;
        REQUIRE(apart > 2 * same);
      }
    }
  }
  REQUIRE(others == 47);
}
