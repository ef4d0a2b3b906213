// Sums over tiles against their definition.
#include <catch2/catch.hpp>

#include "light/support.h"
#include "light/tile_table.h"
#include "sh/quadrature.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// The integral over [low, high] of the polynomial that is 1 in nodes[which] and 0 in the others, by twice the nodes
/// that it needs.
double cellIntegral(const std::vector<double>& nodes, std::size_t which, double low, double high) {
  const sh::IntervalRule rule = sh::gaussLegendre(static_cast<int>(nodes.size()) + 1);
  double sum = 0;
  for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
    const double x = (low + high) / 2 + (high - low) / 2 * rule.nodes[q];
    double value = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != which) value *= (x - nodes[j]) / (nodes[which] - nodes[j]);
    }
    sum += rule.weights[q] * (high - low) / 2 * value;
  }
  return sum;
}

/// The definition, term by term.
template <class T>
double sumOf(const std::vector<double>& nodes, std::size_t k, const std::vector<std::vector<T>>& rows, int column) {
  const double width = static_cast<double>(rows.size());
  double sum = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double low = -1 + 2 * static_cast<double>(i) / width, high = -1 + 2 * static_cast<double>(i + 1) / width;
    sum += cellIntegral(nodes, k, low, high) * static_cast<double>(rows[i][static_cast<std::size_t>(column)]);
  }
  return sum;
}

template <class T>
void compare(int nodeCount, int width, int columns, TileTable::Scratch& scratch) {
  const std::vector<double> nodes = sh::gaussLegendre(nodeCount).nodes;
  std::vector<std::vector<T>> rows(static_cast<std::size_t>(width));
  std::vector<const T*> pointers;
  std::uint64_t n = 0;
  for (auto& row : rows) {
    for (int j = 0; j < columns; ++j) row.push_back(static_cast<T>(2 * hashUnit(61, n++) - 1));
    pointers.push_back(row.data());
  }
  const TileTable table(nodes, width);
  REQUIRE((table.nodes() == nodes && table.width() == width));
  std::vector<double> out(nodes.size() * static_cast<std::size_t>(columns), NAN);
  table.contract<T>(pointers, columns, out, scratch);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (int j = 0; j < columns; ++j) {
      INFO(nodeCount << " nodes, " << width << " cells, node " << k << " column " << j);
      // Integrals stay below 2 and are exact to some ulps of the products within; a hundred of them cover both sums.
      REQUIRE(out[k * columns + j] == Approx(sumOf(nodes, k, rows, j)).margin(1e-13));
    }
  }
}

}  // namespace

TEST_CASE("a tile's sums are those of its definition, for any number of nodes, cells and columns") {
  TileTable::Scratch scratch;
  for (const int nodes : {1, 2, 5, 8, 13}) {
    for (const int width : {1, 2, 3, 7, 8, 9, 16, 33, 64}) {
      compare<float>(nodes, width, 5, scratch);
      compare<double>(nodes, width, 12, scratch);
    }
  }
}

TEST_CASE("constant cells give each node its weight") {
  const sh::IntervalRule rule = sh::gaussLegendre(9);
  const TileTable table(rule.nodes, 20);
  const std::vector<float> ones(3, 1.0f);
  const std::vector<const float*> rows(20, ones.data());
  std::vector<double> out(27);
  TileTable::Scratch scratch;
  table.contract<float>(rows, 3, out, scratch);
  for (std::size_t k = 0; k < 27; ++k) REQUIRE(out[k] == Approx(rule.weights[k / 3]).epsilon(1e-13));
}
