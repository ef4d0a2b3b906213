#include "mesh/edge_groups.h"

#include <algorithm>

namespace shbake {

EdgeGroups::EdgeGroups(std::span<const Triangle> faces, std::size_t points) : faces_(faces), starts_(points + 1, 0) {
  const auto forEachSide = [&](auto&& visit) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      if (repeatsPoint(faces[f])) continue;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(faces[f][c], faces[f][(c + 1) % 3]);
        visit(low, high, 3 * f + c);
      }
    }
  };
  // A counting sort by the lesser point, then short sorts by the greater one.
  forEachSide([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++starts_[low + 1]; });
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sides_.resize(starts_.back());
  std::vector<std::uint64_t> next(starts_.begin(), starts_.end() - 1);
  forEachSide([&](std::uint32_t low, std::uint32_t high, std::uint32_t side) { sides_[next[low]++] = {high, side}; });
  for (std::size_t i = 0; i < points; ++i) {
    const auto begin = sides_.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(starts_[i]), begin + static_cast<std::ptrdiff_t>(starts_[i + 1]),
              [](const Side& a, const Side& b) { return a.high != b.high ? a.high < b.high : a.side < b.side; });
  }
}

}  // namespace shbake
