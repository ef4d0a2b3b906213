// The file that keeps a reference from one run to the next.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "chart/sweep/reference.h"
#include "mesh/lighting_points.h"

namespace shbake::chart {

/// What a reference depends on, hashed to 128 bits.
using ReferenceKey = std::array<std::uint64_t, 2>;

/// The key of a reference: the mesh as it is traced (positions, faces, normals), the sample, order, rays and the
/// version of shbake.
ReferenceKey referenceKey(const LightingPoints& points, std::span<const std::uint32_t> sample,
                          const ReferenceOptions& options);

enum class CacheState {
  absent,
  other,    ///< whole, but of another key
  damaged,  ///< cut off, changed or no cache at all
  good,
};

/// Reads the cache into `reference` (order and rays already set) where its key and checksum are right; otherwise leaves
/// it as it is.
CacheState readReferenceCache(const std::string& path, const ReferenceKey& key, Reference& reference);

/// Writes it, whole or not at all. Throws an Error that names the file.
void writeReferenceCache(const std::string& path, const ReferenceKey& key, const Reference& reference);

}  // namespace shbake::chart
