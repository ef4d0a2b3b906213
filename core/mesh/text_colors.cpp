#include "mesh/text_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shbake {

ColorEncoding settleTextColors(std::vector<Rgb>& colors, const std::string& what, std::vector<std::string>& warnings) {
  bool whole = true, above1 = false;
  for (const Rgb& c : colors) {
    if (std::isnan(c.x)) continue;
    for (const float v : {c.x, c.y, c.z}) {
      whole = whole && v == std::floor(v);
      above1 = above1 || v > 1;
    }
  }
  const bool bytes = whole && above1;
  const float range = bytes ? 255.0f : 1.0f;
  std::size_t clamped = 0, missing = 0;
  for (Rgb& c : colors) {
    if (std::isnan(c.x)) {
      c = Rgb(1, 1, 1);
      ++missing;
      continue;
    }
    const auto settle = [&](float v) {
      const float inside = std::clamp(v, 0.0f, range);
      clamped += inside != v;
      return inside / range;
    };
    c = {settle(c.x), settle(c.y), settle(c.z)};
  }
  if (clamped > 0) {
    warnings.push_back(std::to_string(clamped) + " numbers of the " + what + " are outside 0.." +
                       (bytes ? "255" : "1") + " and were clamped");
  }
  if (missing > 0) {
    warnings.push_back(std::to_string(missing) + " of " + std::to_string(colors.size()) + " " + what +
                       " are missing and were taken as white");
  }
  return bytes ? ColorEncoding::srgb : ColorEncoding::linear;
}

}  // namespace shbake
