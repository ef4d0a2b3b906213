// The facts about a transfer as "shbake key=value …" comments in the header of a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transfer/transfer_set.h"

namespace shbake {

/// What the comments of a file state.
struct StatedFacts {
  bool any = false;                ///< there are such comments
  TransferFacts facts;             ///< defaults where the comments are silent
  std::optional<int> order;        ///< 1..kMostBands
  std::optional<int> channels;     ///< 1 or 3
  bool condonShortley = false;     ///< the coefficients are in the basis with Condon-Shortley phase
  std::vector<std::string> notes;  ///< what had to be assumed or was not understood, one sentence each

  static constexpr int kMostBands = 1000;
};

/// True for a comment line that states facts: "shbake", a blank, and a word with '=' in it.
bool isFactComment(std::string_view comment);

/// The comments that state all facts of a transfer, in the order of the conventions (section PLY). Blanks, '%' and
/// control characters within a value become %XX, so that a value never ends early. What albedo was taken follows in a
/// line of its own where it is known, as do the limits of what was traced where there are any, and the surface error
/// where it was measured.
std::vector<std::string> factComments(const TransferFacts& facts, int order, int channels);

/// Reads the facts back from all comments of a file; comments that state none are passed over. Facts about the basis
/// that are missing are assumed and noted, keys that are not known noted and ignored.
/// Throws an Error with `file` that names the field: values that cannot be read or are out of range, two values for one
/// key, a basis, axes or units that shbake does not use.
StatedFacts parseFacts(const std::vector<std::string>& comments, const std::string& file);

}  // namespace shbake
