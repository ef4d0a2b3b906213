// The columns of a file that hold a transfer: which property is which coefficient.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/ply_header.h"
#include "transfer/transfer_facts.h"

namespace shbake {

/// The name of a coefficient's column: "sh_4" with one channel, "sh_g_4" with three.
std::string shColumnName(int channels, int channel, int index);

/// True for the names of all columns that belong to a transfer: coefficients, "quality", "sh_error", "source_vertex".
bool isTransferColumn(std::string_view name);

/// How the columns of an element make up transfer vectors.
struct ShColumns {
  int order = 0;
  int channels = 0;
  /// For each of the given properties the place of its values in a transfer vector, channel by channel; or nothing.
  std::vector<std::optional<std::size_t>> place;
};

/// Finds the columns of the coefficients among the properties of the vertices; nothing when there are none.
/// Throws an Error with `file` that names what contradicts itself: sh_0 beside sh_r_0, a missing coefficient, more or
/// fewer of them than `stated` says, channels other than stated, coefficients that are not floats, or a number of them
/// that is not a square.
std::optional<ShColumns> findShColumns(const std::vector<PlyProperty>& properties, const StatedFacts& stated,
                                       const std::string& file);

}  // namespace shbake
