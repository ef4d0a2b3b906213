// Counting and replacing pixels that are no radiance.
#include "light/bad_pixels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "light/vector_clones.h"

namespace shbake {
namespace {

template <class Test>
bool any(const Rgb& p, Test&& test) {
  return test(p.x) || test(p.y) || test(p.z);
}

float repaired(float v, float mostFinite, bool keepNegative) {
  if (std::isinf(v)) return v > 0 ? mostFinite : 0;
  return keepNegative ? v : std::max(v, 0.0f);
}

/// True where no sign bit is set and no exponent is that of infinities and NaNs: adding 1 to it then leaves the sign
/// bit clear, too.
SHBAKE_VECTOR_CLONES bool isSurelyGood(std::span<const Rgb> row) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  if (row.empty()) return true;
  const float* values = &row.data()->x;
  std::uint32_t signs = 0;
  for (std::size_t i = 0; i < 3 * row.size(); ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(values[i]);
    signs |= bits | (bits + 0x00800000u);
  }
  return signs >> 31 == 0;
}

}  // namespace

void BadPixels::add(const BadPixels& later) {
  if (total() == 0) {
    x = later.x;
    y = later.y;
  }
  nan += later.nan;
  infinite += later.infinite;
  negative += later.negative;
}

BadPixels repairRow(std::span<Rgb> row, int y, float mostFinite, bool keepNegative) {
  BadPixels found;
  // One pass without branches decides whether anything may be wrong, which is nearly never so.
  if (isSurelyGood(row)) return found;

  for (std::size_t x = 0; x < row.size(); ++x) {
    Rgb& p = row[x];
    const bool isNan = any(p, [](float v) { return std::isnan(v); });
    const bool isInfinite = any(p, [](float v) { return std::isinf(v); });
    const bool isNegative = any(p, [](float v) { return v < 0; });
    if (!isNan && !isInfinite && !isNegative) continue;
    if (found.total() == 0) {
      found.x = static_cast<int>(x);
      found.y = y;
    }
    ++(isNan ? found.nan : isInfinite ? found.infinite : found.negative);
    p = isNan ? Rgb{}
              : Rgb{repaired(p.x, mostFinite, keepNegative), repaired(p.y, mostFinite, keepNegative),
                    repaired(p.z, mostFinite, keepNegative)};
  }
  return found;
}

}  // namespace shbake
