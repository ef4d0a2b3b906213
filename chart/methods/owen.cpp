// Sobol' points and Owen's scrambling.
#include "chart/methods/owen.h"

#include "base/hash.h"

namespace shbake::chart {

std::uint32_t sobolBits(std::uint32_t index, int dimension) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 0x80000000u; index != 0; index >>= 1) {
    if ((index & 1) != 0) result ^= column;
    column = dimension == 0 ? column >> 1 : column ^ column >> 1;
  }
  return result;
}

std::uint32_t owenScrambled(std::uint32_t bits, std::uint64_t seed) {
  std::uint32_t result = 0;
  for (int b = 0; b < 32; ++b) {
    // The node of the tree that the bits above lead to: a leading one keeps nodes of different depth apart.
    const std::uint64_t node = (std::uint64_t{1} << b) | (std::uint64_t{bits} >> (32 - b));
    const auto coin = static_cast<std::uint32_t>(hashBits(seed, node) >> 63);
    result = result << 1 | ((bits >> (31 - b) & 1) ^ coin);
  }
  return result;
}

}  // namespace shbake::chart
