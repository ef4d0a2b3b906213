// Which lighting points of a mesh are measured: blocks in bit-reversed order.
#include "chart/sweep/sample.h"

#include <algorithm>
#include <bit>

namespace shbake::chart {

std::vector<std::uint32_t> samplePoints(std::size_t count, std::size_t most) {
  const std::size_t blocks = (count + kSampleBlock - 1) / kSampleBlock;
  const std::size_t taken = std::clamp<std::size_t>(most / kSampleBlock, 1, std::max<std::size_t>(blocks, 1));
  const auto bits = static_cast<int>(std::bit_width(taken - 1));
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < std::size_t{1} << bits; ++i) {
    std::size_t reversed = 0;
    for (int b = 0; b < bits; ++b) reversed |= (i >> b & 1) << (bits - 1 - b);
    if (reversed >= taken) continue;
    const std::size_t begin = reversed * blocks / taken * kSampleBlock;
    for (std::size_t p = begin; p < std::min(begin + kSampleBlock, count); ++p) {
      points.push_back(static_cast<std::uint32_t>(p));
    }
  }
  return points;
}

}  // namespace shbake::chart
