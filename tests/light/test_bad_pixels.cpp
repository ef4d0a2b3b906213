// Pixels that cannot be radiance, one kind at a time.
#include <catch2/catch.hpp>
#include <cfloat>

#include "light/bad_pixels.h"
#include "light/support.h"

using namespace shbake;

namespace {

/// A row of good pixels but for one channel of one.
std::vector<Rgb> rowWith(float value, std::size_t pixel, int channel) {
  std::vector<Rgb> row(37, Rgb(1, FLT_MAX, FLT_TRUE_MIN));
  (channel == 0 ? row[pixel].x : channel == 1 ? row[pixel].y : row[pixel].z) = value;
  return row;
}

}  // namespace

TEST_CASE("each kind of bad value is found in every place of a row") {
  struct Kind {
    float value;
    std::size_t nan, infinite, negative;
    float becomes;  ///< NaN: the whole pixel is black
  };
  const float inf = INFINITY, nan = NAN;
  for (const Kind& kind : {Kind{nan, 1, 0, 0, 0}, Kind{-nan, 1, 0, 0, 0}, Kind{inf, 0, 1, 0, 9}, Kind{-inf, 0, 1, 0, 0},
                           Kind{-1, 0, 0, 1, 0}, Kind{-FLT_TRUE_MIN, 0, 0, 1, 0}, Kind{-FLT_MAX, 0, 0, 1, 0}}) {
    for (std::size_t pixel = 0; pixel < 37; ++pixel) {
      for (int channel = 0; channel < 3; ++channel) {
        std::vector<Rgb> row = rowWith(kind.value, pixel, channel);
        const BadPixels found = repairRow(row, 5, 9, false);
        INFO(kind.value << " in channel " << channel << " of pixel " << pixel);
        REQUIRE((found.nan == kind.nan && found.infinite == kind.infinite && found.negative == kind.negative));
        REQUIRE((found.x == static_cast<int>(pixel) && found.y == 5));
        const Rgb expected = kind.nan ? Rgb() : rowWith(kind.becomes, pixel, channel)[pixel];
        REQUIRE(row[pixel] == expected);
        REQUIRE(row[(pixel + 1) % 37] == Rgb(1, FLT_MAX, FLT_TRUE_MIN));
      }
    }
  }
}

TEST_CASE("zeros of either sign, the least and the largest numbers are good") {
  for (const float value : {0.0f, -0.0f, FLT_TRUE_MIN, FLT_MAX}) {
    std::vector<Rgb> row = rowWith(value, 20, 1);
    REQUIRE(repairRow(row, 0, 0, false).total() == 0);
    REQUIRE(row == rowWith(value, 20, 1));
  }
  REQUIRE(repairRow({}, 0, 0, false).total() == 0);
}

TEST_CASE("negative values stay where they are wanted, but are counted") {
  std::vector<Rgb> row = rowWith(-2, 3, 2);
  REQUIRE(repairRow(row, 0, 0, true).negative == 1);
  REQUIRE(row[3].z == -2);
}
