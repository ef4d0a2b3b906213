#include "mesh/edge_groups.h"

#include <algorithm>

namespace shbake {

EdgeGroups::EdgeGroups(std::span<const Triangle> faces, std::size_t points, Passes& passes)
    : faces_(faces), starts_(points + 1, 0) {
  const auto forEachSide = [&](auto&& visit) {
    passes.forEach<std::uint32_t>(faces.size(), [&](std::uint32_t f) {
      if (repeatsPoint(faces[f])) return;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(faces[f][c], faces[f][(c + 1) % 3]);
        visit(low, high, 3 * f + c);
      }
    });
  };
  // A counting sort by the lesser point, then short sorts by the greater one.
  forEachSide([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++starts_[low + 1]; });
  passes.forEach(points, [&](std::size_t i) { starts_[i + 1] += starts_[i]; });
  sides_.resize(starts_.back());
  std::vector<std::uint64_t> next(starts_.begin(), starts_.end() - 1);
  forEachSide([&](std::uint32_t low, std::uint32_t high, std::uint32_t side) { sides_[next[low]++] = {high, side}; });
  passes.forEach(points, [&](std::size_t i) {
    const auto begin = sides_.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(starts_[i]), begin + static_cast<std::ptrdiff_t>(starts_[i + 1]),
              [](const Side& a, const Side& b) { return a.high != b.high ? a.high < b.high : a.side < b.side; });
  });
}

}  // namespace shbake
