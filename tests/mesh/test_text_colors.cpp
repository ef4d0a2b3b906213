// What colours of text files mean.
#include <catch2/catch.hpp>

#include "mesh/text_colors.h"

using namespace shbake;

namespace {

struct Settled {
  std::vector<Rgb> colors;
  ColorEncoding encoding;
  std::vector<std::string> warnings;
};

Settled settle(std::vector<Rgb> colors) {
  Settled s{std::move(colors), ColorEncoding::linear, {}};
  s.encoding = settleTextColors(s.colors, "face colours", s.warnings);
  return s;
}

}  // namespace

TEST_CASE("whole numbers above 1 are bytes") {
  const Settled s = settle({{255, 51, 0}, {1, 0, 1}});
  CHECK(s.encoding == ColorEncoding::srgb);
  CHECK(s.colors == std::vector<Rgb>{{1, 0.2f, 0}, {1 / 255.f, 0, 1 / 255.f}});
  CHECK(s.warnings.empty());
}

TEST_CASE("fractions, or zeros and ones alone, are linear floats") {
  CHECK(settle({{1, 0, 1}}).encoding == ColorEncoding::linear);
  CHECK(settle({{1, 0, 1}}).colors == std::vector<Rgb>{{1, 0, 1}});
  CHECK(settle({{0.5f, 0, 1}}).encoding == ColorEncoding::linear);
}

TEST_CASE("numbers out of range are clamped and counted") {
  const Settled floats = settle({{1.5f, -0.25f, 0.5f}});
  CHECK(floats.colors == std::vector<Rgb>{{1, 0, 0.5f}});
  CHECK(floats.warnings == std::vector<std::string>{"2 numbers of the face colours are outside 0..1 and were clamped"});
  const Settled bytes = settle({{300, -1, 51}});
  CHECK(bytes.colors == std::vector<Rgb>{{1, 0, 0.2f}});
  CHECK(bytes.warnings ==
        std::vector<std::string>{"2 numbers of the face colours are outside 0..255 and were clamped"});
}

TEST_CASE("missing colours become white and do not take part in the decision") {
  const Settled s = settle({kNoColor, {102, 0, 0}});
  CHECK(s.encoding == ColorEncoding::srgb);
  CHECK(s.colors == std::vector<Rgb>{{1, 1, 1}, {0.4f, 0, 0}});
  CHECK(s.warnings == std::vector<std::string>{"1 of 2 face colours are missing and were taken as white"});
}
