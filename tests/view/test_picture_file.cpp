// Pictures as they are read back from files.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/srgb.h"
#include "view/picture_file.h"

using namespace shbake;

namespace {

struct TemporaryFile {
  std::string path;
  explicit TemporaryFile(const std::string& name)
      : path((std::filesystem::temp_directory_path() / ("shbake-picture-" + std::to_string(::getpid()) + name))
                 .string()) {}
  ~TemporaryFile() { std::filesystem::remove(path); }
};

Rgb level(int x, int y) {
  return {static_cast<float>(x) / 6, static_cast<float>(y) / 4, 0.25f};
}

Picture gradient() {
  Picture picture(7, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) picture.at(x, y) = level(x, y);
  }
  return picture;
}

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a PNG holds the sRGB bytes of display light") {
  const TemporaryFile file(".png");
  writePicture(file.path, gradient());
  const auto input = OIIO::ImageInput::open(file.path);
  REQUIRE(input);
  REQUIRE((input->spec().width == 7 && input->spec().height == 5 && input->spec().nchannels == 3));
  REQUIRE(input->spec().format == OIIO::TypeUInt8);
  std::vector<unsigned char> bytes(7 * 5 * 3);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, bytes.data()));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const unsigned char* pixel = &bytes[static_cast<std::size_t>(3 * (7 * y + x))];
      REQUIRE(std::abs(pixel[0] - 255 * linearToSrgb(level(x, y).x)) <= 0.501f);
      REQUIRE(std::abs(pixel[1] - 255 * linearToSrgb(level(x, y).y)) <= 0.501f);
      REQUIRE(pixel[2] == 137);  // 0.25 linear is 0.537 of white
    }
  }
}

TEST_CASE("an EXR holds radiance, beyond white and below zero") {
  const TemporaryFile file(".exr");
  Picture picture = gradient();
  picture.at(0, 0) = {1000, -2, 0.5f};
  writePicture(file.path, picture);
  const auto input = OIIO::ImageInput::open(file.path);
  REQUIRE(input);
  REQUIRE((input->spec().width == 7 && input->spec().height == 5));
  std::vector<float> values(7 * 5 * 3);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeFloat, values.data()));
  CHECK((values[0] == 1000 && values[1] == -2 && values[2] == 0.5f));
  for (std::size_t i = 1; i < 35; ++i) {
    REQUIRE(std::abs(values[3 * i] - picture.pixels[i].x) <= 0x1p-12f);  // half a step of a half float below 1
  }
}

TEST_CASE("the same picture gives the same bytes; other endings are refused") {
  const TemporaryFile a("a.exr"), b("b.exr"), c("c.png"), d("d.png");
  writePicture(a.path, gradient());
  writePicture(b.path, gradient());
  CHECK(bytesOf(a.path) == bytesOf(b.path));
  writePicture(c.path, gradient());
  writePicture(d.path, gradient());
  CHECK(bytesOf(c.path) == bytesOf(d.path));
  CHECK_FALSE(bytesOf(c.path).empty());
  CHECK_THROWS_AS(writePicture("picture.gif", gradient()), Error);
}

TEST_CASE("pictures side by side keep their pixels, and captions leave ink below") {
  const Picture left(60, 40, {1, 0, 0}), right(80, 40, {0, 1, 0});
  const std::vector<Picture> both{left, right};
  const std::vector<std::string> captions{"a", "shadowed"};
  const Picture plain = sideBySide(both, {}), strip = sideBySide(both, captions);
  CHECK((plain.width == 141 && plain.height == 40));
  CHECK((strip.width == 141 && strip.height == 60));
  CHECK(strip.at(59, 39) == Rgb(1, 0, 0));
  CHECK(strip.at(61, 0) == Rgb(0, 1, 0));
  double inkLeft = 0, inkRight = 0;
  for (int y = 40; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) inkLeft += strip.at(x, y).x > 0.3f;
    for (int x = 61; x < 141; ++x) inkRight += strip.at(x, y).x > 0.3f;
  }
  CHECK(inkLeft > 5);
  CHECK(inkRight > 5 * inkLeft);
  CHECK_THROWS_AS(sideBySide(both, std::vector<std::string>{"one"}), Error);
  CHECK_THROWS_AS(sideBySide(std::vector<Picture>{left, Picture(3, 3)}, {}), Error);
}
