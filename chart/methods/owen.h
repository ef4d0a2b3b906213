// Owen's nested uniform scrambling of Sobol' points in two dimensions.
#pragma once

#include <cstdint>

namespace shbake::chart {

/// Coordinate `dimension` (0 or 1) of Sobol' point `index` as a binary fraction of 32 bits: van der Corput's sequence
/// and the one of the polynomial x + 1 (I. M. Sobol', USSR Comp. Math. Math. Phys. 7, 1967).
std::uint32_t sobolBits(std::uint32_t index, int dimension);

/// Owen's scrambling of a fraction of 32 bits ("Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995): each bit is
/// flipped by a coin that depends on all bits above it. The coins are hashes of seed and these bits, so that no tree is
/// stored (B. Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020). His single hash for all bits
/// (Laine-Karras) is faster and not quite uniform; tables are made once and can afford a hash for each bit.
std::uint32_t owenScrambled(std::uint32_t bits, std::uint64_t seed);

}  // namespace shbake::chart
