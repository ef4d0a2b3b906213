// Disjoint sets of numbers: B. A. Galler, M. J. Fischer, "An improved equivalence algorithm", CACM 1964, with path
// halving (R. E. Tarjan, J. van Leeuwen, "Worst-case analysis of set union algorithms", JACM 1984).
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace shbake {

/// Sets over 0..n-1, at first one for each number. The least member represents its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) {
      parent_[b] = a;
    } else {
      parent_[a] = b;
    }
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace shbake
