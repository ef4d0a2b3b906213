// Numbers as people read them: at the places where digits, prefixes and units change.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "cli/format.h"

using namespace shbake::cli;

TEST_CASE("counts have their thousands marked") {
  CHECK(formatCount(0) == "0");
  CHECK(formatCount(999) == "999");
  CHECK(formatCount(1000) == "1,000");
  CHECK(formatCount(1234567) == "1,234,567");
  CHECK(formatCount(~std::uint64_t(0)) == "18,446,744,073,709,551,615");
}

TEST_CASE("magnitudes have three digits and roll over to the next prefix when rounding does") {
  CHECK(formatShort(0) == "0");
  CHECK(formatShort(0.5234) == "0.523");
  CHECK(formatShort(9.994) == "9.99");
  CHECK(formatShort(9.996) == "10.0");
  CHECK(formatShort(99.96) == "100");
  CHECK(formatShort(999.4) == "999");
  CHECK(formatShort(999.6) == "1.00 k");
  CHECK(formatShort(12.345e6) == "12.3 M");
  CHECK(formatShort(7.89e11) == "789 G");
  CHECK(formatShort(1e18) == "1000000 T");
  CHECK(formatShort(-1234) == "-1.23 k");
}

TEST_CASE("bytes are whole until they carry a prefix") {
  CHECK(formatBytes(0) == "0 B");
  CHECK(formatBytes(999) == "999 B");
  CHECK(formatBytes(1000) == "1.00 kB");
  CHECK(formatBytes(123456789) == "123 MB");
}

TEST_CASE("durations go from hundredths to hours") {
  CHECK(formatDuration(0) == "0.00 s");
  CHECK(formatDuration(9.99) == "9.99 s");
  CHECK(formatDuration(9.996) == "10.0 s");
  CHECK(formatDuration(59.94) == "59.9 s");
  CHECK(formatDuration(59.96) == "1:00");
  CHECK(formatDuration(125.4) == "2:05");
  CHECK(formatDuration(3599.6) == "1:00:00");
  CHECK(formatDuration(3723) == "1:02:03");
}

TEST_CASE("ratios are percent with three digits") {
  CHECK(formatPercent(0) == "0 %");
  CHECK(formatPercent(0.00981) == "0.981 %");
  CHECK(formatPercent(0.042) == "4.20 %");
  CHECK(formatPercent(1) == "100 %");
}

TEST_CASE("numbers read back to what they were") {
  for (const double value : {0.1, 1e-300, 123456789.123, 0.01, -2.5}) {
    CHECK(std::strtod(formatNumber(value).c_str(), nullptr) == value);
  }
  CHECK(formatNumber(0.01) == "0.01");
  CHECK(formatNumber(3.14159265, 3) == "3.14");
}
