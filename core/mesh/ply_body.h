// Bodies of PLY files: rows of declared elements, decoded into columns.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "mesh/ply_header.h"
#include "mesh/ply_input.h"
#include "mesh/property.h"

namespace shbake {

/// Receives one list of integers per item of an element, instead of a column that would hold them all.
using PlyListSink = std::function<void(std::uint64_t item, std::span<const std::int64_t> list)>;

/// An item as messages name it: "vertex 7".
std::string plyItemName(const PlyElement& element, std::uint64_t item);

/// Reads the elements of a PLY file's body, which has to happen in the order of the header. Memory never exceeds a
/// small multiple of the file's size, whatever the header promises. Progress advances by the bytes read.
class PlyBody {
 public:
  /// `input` stands at the first byte behind `header`. All three are only borrowed.
  PlyBody(PlyInput& input, const PlyHeader& header, Progress& progress)
      : input_(input), header_(header), progress_(progress) {}

  /// All columns of the next element, in the order of its declaration. The list called `sinkList`, of an integer type,
  /// goes to `sink` row by row and is left out.
  /// Throws an Error that names the item (and in ASCII the line): a file that ends early, a number that cannot be read
  /// or does not fit its type, too few or too many values on a line, a list of negative length.
  std::vector<Property> readElement(const PlyElement& element, std::string_view sinkList = {},
                                    const PlyListSink& sink = {});

 private:
  PlyInput& input_;
  const PlyHeader& header_;
  Progress& progress_;
};

}  // namespace shbake
