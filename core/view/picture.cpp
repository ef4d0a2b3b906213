// Pictures in memory, and how they are put side by side.
#include "view/picture.h"

#include <algorithm>

#include "base/error.h"
#include "view/caption.h"

namespace shbake {
namespace {

/// Of the gaps and the ground of captions, in linear light: dark enough for pages of any colour.
constexpr Rgb kGround{0.012f, 0.012f, 0.014f};
constexpr Rgb kInk{0.72f, 0.72f, 0.72f};

void paste(const Picture& from, Picture& to, int left) {
  for (int y = 0; y < from.height; ++y) {
    std::copy_n(&from.at(0, y), from.width, &to.at(left, y));
  }
}

}  // namespace

Picture::Picture(int width_, int height_, const Rgb& fill) : width(width_), height(height_) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels) {
    throw usageError("a picture of " + std::to_string(width) + "x" + std::to_string(height) + " pixels cannot be made",
                     "give sides of 1 to " + std::to_string(kMostPixels) + " pixels");
  }
  pixels.assign(static_cast<std::size_t>(width) * height, fill);
}

Picture sideBySide(std::span<const Picture> pictures, std::span<const std::string> captions) {
  if (pictures.empty()) throw usageError("there is no picture");
  if (!captions.empty() && captions.size() != pictures.size()) {
    throw usageError("there are " + std::to_string(captions.size()) + " captions for " +
                         std::to_string(pictures.size()) + " pictures",
                     "give one for each");
  }
  const int height = pictures[0].height, gap = std::max(1, height / 100);
  int width = gap * (static_cast<int>(pictures.size()) - 1);
  for (const Picture& p : pictures) {
    if (p.height != height) throw usageError("pictures side by side differ in height");
    width += p.width;
  }
  const int letter = std::max(10, height / 20), bar = captions.empty() ? 0 : 2 * letter;
  Picture strip(width, height + bar, kGround);
  int left = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    paste(pictures[i], strip, left);
    if (bar > 0) drawCaption(strip, captions[i], {left + pictures[i].width / 2.0, height + bar / 2.0}, letter, kInk);
    left += pictures[i].width + gap;
  }
  return strip;
}

}  // namespace shbake
