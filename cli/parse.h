// Values of options as people type them. Each function takes the option's name for its message and throws a usage error
// "NAME: 'TEXT' is not ...; give ..." for text that it does not understand or a value out of range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "shbake.h"

namespace shbake::cli {

/// A whole number in least..most.
std::int64_t parseWhole(const std::string& name, const std::string& text, std::int64_t least, std::int64_t most);

/// A finite number in least..most.
double parseReal(const std::string& name, const std::string& text, double least, double most);

/// A number of bytes, 1 or more, with an optional suffix K, M, G or T for powers of 1024 ("512M", "1.5G", "64KiB").
std::size_t parseBytes(const std::string& name, const std::string& text);

/// One grey value or three with commas between, each in 0..1.
Rgb parseRgb(const std::string& name, const std::string& text);

}  // namespace shbake::cli
