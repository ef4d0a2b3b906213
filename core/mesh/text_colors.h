// What the numbers of a colour in a text file mean.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace shbake {

/// Stands for a colour that the file does not give.
inline constexpr Rgb kNoColor{std::numeric_limits<float>::quiet_NaN(), 0, 0};

/// Decides how the colours of a file are encoded and scales them to 0..1. Text formats do not say it, so the numbers
/// must: whole numbers of which at least one exceeds 1 are 8-bit display values (divided by 255: ColorEncoding::srgb),
/// all others linear floats. Numbers outside the range of their kind are clamped and kNoColor becomes white, each with
/// a warning that names `what` ("vertex colours").
ColorEncoding settleTextColors(std::vector<Rgb>& colors, const std::string& what, std::vector<std::string>& warnings);

}  // namespace shbake
