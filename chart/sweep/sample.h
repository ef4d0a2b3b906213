// Which lighting points of a mesh are measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shbake::chart {

/// At most `most` of the points 0..count-1, in blocks of 16 that follow each other along the Morton curve, so that they
/// are traced about as coherently as all of them would be. The blocks come in bit-reversed order: any number of first
/// ones is spread evenly over the mesh.
std::vector<std::uint32_t> samplePoints(std::size_t count, std::size_t most);

/// Points of a block.
inline constexpr std::size_t kSampleBlock = 16;

}  // namespace shbake::chart
