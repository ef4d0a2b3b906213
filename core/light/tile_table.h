// Interpolation on a row of cells: what the cells' contents add to each node.
#pragma once

#include <span>
#include <vector>

namespace shbake {

/// The polynomials that are 1 in one of `nodes` and 0 in the others, integrated over each of `width` equal cells that
/// fill [-1, 1]. Nodes lie symmetrically, so that node n - 1 - k sees cell width - 1 - i as node k sees cell i: sums
/// and differences of opposite cells meet half of the nodes each.
class TileTable {
 public:
  TileTable() = default;
  /// `nodes` rise and are symmetrical about 0.
  TileTable(std::vector<double> nodes, int width);

  const std::vector<double>& nodes() const { return nodes_; }
  int width() const { return width_; }

  /// What contract() works in, to be used again and again.
  struct Scratch {
    std::vector<double> even, odd, sums, differences;
  };

  /// For each node k and column j, out[k * columns + j] becomes the sum over cells i of integral(k, i) * rows[i][j].
  /// `rows` has a pointer to `columns` numbers for each cell.
  template <class T>
  void contract(std::span<const T* const> rows, int columns, std::span<double> out, Scratch& scratch) const;

 private:
  void addPairs(int firstPair, int columns, Scratch& scratch) const;

  std::vector<double> nodes_;
  int width_ = 0;
  int pairs_ = 0;             ///< of opposite cells, the middle one of an odd width by itself, padded to whole groups
  std::vector<double> even_;  ///< [k * pairs_ + pair]: integral of node k plus that of node n - 1 - k
  std::vector<double> odd_;   ///< the same of differences
};

}  // namespace shbake
