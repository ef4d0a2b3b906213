// Counter-based random numbers: a value depends on its seed and index alone, never on the order of work.
#pragma once

#include <cstdint>

namespace shbake {

/// A well mixed 64-bit hash of its argument (the finaliser of SplitMix64: Steele, Lea, Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014).
constexpr std::uint64_t mixBits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

/// Random bits number `index` of the stream `seed`.
constexpr std::uint64_t hashBits(std::uint64_t seed, std::uint64_t index) {
  return mixBits(mixBits(seed + 0x9E3779B97F4A7C15ull) + (index + 1) * 0x9E3779B97F4A7C15ull);
}

/// Random number `index` of the stream `seed`, uniform in [0, 1).
constexpr double hashUnit(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(hashBits(seed, index) >> 11) * 0x1p-53;
}

}  // namespace shbake
