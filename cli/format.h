// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace shbake::cli {

/// A count with its thousands marked: "1,234,567".
std::string formatCount(std::uint64_t count);

/// A magnitude in three digits and a decimal prefix: "0.52", "1.23 k", "45.6 M", "789 G".
std::string formatShort(double value);

/// Bytes in three digits and a decimal unit: "512 B", "1.23 MB".
std::string formatBytes(double bytes);

/// A time span of at least 0 seconds: "0.04 s", "12.3 s", "2:05", "1:02:03".
std::string formatDuration(double seconds);

/// A ratio as percent in three digits: "0.981 %", "4.20 %", "100 %".
std::string formatPercent(double ratio);

/// A number in the shortest decimal form that reads back to the same double, or in `digits` significant digits.
std::string formatNumber(double value);
std::string formatNumber(double value, int digits);

}  // namespace shbake::cli
