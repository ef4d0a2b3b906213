// Counting and replacing pixels that are no radiance.
#include "light/bad_pixels.h"

#include <algorithm>
#include <cmath>

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
  // One pass without branches decides whether anything is wrong, which is nearly never so.
  const auto isBad = [](float v) { return static_cast<int>(!(v >= 0)) | static_cast<int>(!(v < INFINITY)); };
  int bad = 0;
  for (const Rgb& p : row) bad |= isBad(p.x) | isBad(p.y) | isBad(p.z);
  if (bad == 0) return found;

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
