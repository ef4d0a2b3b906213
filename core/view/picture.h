// Pictures in memory, and how they are put side by side.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// Pixels from the upper left one, row by row. Their unit (radiance or display light) is the maker's.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Picture() = default;
  /// Throws a usage error unless both sides are 1..kMostPixels.
  Picture(int width, int height, const Rgb& fill = {});

  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }

  static constexpr int kMostPixels = 16384;
};

/// Pictures of one height side by side, a gap between, each above its caption. No captions: no room is left for them.
/// Throws a usage error when there is no picture, heights differ, or there are captions but not one for each.
Picture sideBySide(std::span<const Picture> pictures, std::span<const std::string> captions);

}  // namespace shbake
