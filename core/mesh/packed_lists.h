// Lists of unequal length in two arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shbake {

/// Lists of unequal length, packed: list i is items[starts[i]] .. items[starts[i+1]-1].
struct PackedLists {
  std::vector<std::uint32_t> starts{0};
  std::vector<std::uint32_t> items;

  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {items.data() + starts[i], items.data() + starts[i + 1]};
  }
  std::size_t size() const { return starts.size() - 1; }
};

}  // namespace shbake
