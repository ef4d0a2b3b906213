// Values of options as people type them: what is understood, and what the message says of the rest.
#include <catch2/catch.hpp>

#include "cli/parse.h"

using namespace shbake;
using namespace shbake::cli;

namespace {

template <class Work>
std::string complaint(Work work) {
  try {
    work();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("whole numbers are read to the ends of their range and not beyond") {
  CHECK(parseWhole("--order", "1", 1, 8) == 1);
  CHECK(parseWhole("--order", "8", 1, 8) == 8);
  CHECK(parseWhole("--seed", "9223372036854775807", 0, INT64_MAX) == INT64_MAX);
  CHECK(complaint([] { parseWhole("--order", "9", 1, 8); }) ==
        "--order: 9 is out of range; give a whole number from 1 to 8");
  for (const char* bad : {"", "four", "4.0", "4x", " 4", "99999999999999999999", "0x10", "+4"}) {
    INFO(bad);
    CHECK_THAT(complaint([&] { parseWhole("--order", bad, 1, 8); }), Catch::Contains("is not a whole number; give"));
  }
}

TEST_CASE("numbers are read without regard to the locale, and nan or infinity are none") {
  CHECK(parseReal("--tolerance", "0.01", 0, 1) == 0.01);
  CHECK(parseReal("--tolerance", "1e-3", 0, 1) == 1e-3);
  CHECK_THAT(complaint([] { parseReal("--tolerance", "2", 1e-4, 1); }),
             Catch::Contains("2 is out of range; give a number from 0.0001 to 1"));
  for (const char* bad : {"", "0,01", "nan", "inf", "1e-3x"}) {
    INFO(bad);
    CHECK_THAT(complaint([&] { parseReal("--tolerance", bad, 0, 1); }), Catch::Contains("is not a number"));
  }
}

TEST_CASE("bytes take suffixes of powers of 1024") {
  CHECK(parseBytes("--memory", "1") == 1);
  CHECK(parseBytes("--memory", "64K") == 65536);
  CHECK(parseBytes("--memory", "512M") == std::size_t(512) << 20);
  CHECK(parseBytes("--memory", "1.5g") == std::size_t(1536) << 20);
  CHECK(parseBytes("--memory", "4GiB") == std::size_t(4) << 30);
  CHECK(parseBytes("--memory", "2TB") == std::size_t(2) << 40);
  CHECK(parseBytes("--memory", "100B") == 100);
  for (const char* bad : {"", "M", "12Q", "12MM", "-5M", "1..5M", "5 M"}) {
    INFO(bad);
    CHECK_THAT(complaint([&] { parseBytes("--memory", bad); }), Catch::Contains("is not a size"));
  }
  for (const char* bad : {"0", "0.2", "9999999999T"}) {
    INFO(bad);
    CHECK_THAT(complaint([&] { parseBytes("--memory", bad); }), Catch::Contains("is out of range"));
  }
}

TEST_CASE("colours are one grey value or three") {
  CHECK(parseRgb("--albedo", "0.5") == Rgb(0.5f, 0.5f, 0.5f));
  CHECK(parseRgb("--albedo", "0.5,0.25,1") == Rgb(0.5f, 0.25f, 1));
  for (const char* bad : {"", "red", "0.5,0.5", "0.5,,0.5", "1,1,1,1", "0.5;0.5;0.5"}) {
    INFO(bad);
    CHECK_THAT(complaint([&] { parseRgb("--albedo", bad); }), Catch::Contains("is not a colour"));
  }
  CHECK_THAT(complaint([] { parseRgb("--albedo", "0.5,1.5,0"); }), Catch::Contains("1.5 is out of range"));
  CHECK_THAT(complaint([] { parseRgb("--albedo", "-0.1"); }), Catch::Contains("-0.1 is out of range"));
}
