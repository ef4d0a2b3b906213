// Integrals over the pixels of cube faces and angular maps, by interpolation in Gauss-Legendre nodes: on one pixel this
// is Gauss-Legendre quadrature, on a tile it shares the evaluations among its pixels.
#include "light/chart_projector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "sh/basis.h"

namespace shbake {
namespace {

using std::numbers::pi;

constexpr int kMaxTile = 64;

/// How fast y_lm times the solid angle per area grows off the real axes. On a cube face the angle is atan(s), whose
/// imaginary part stays below atanh |y|, and the density is (1 + s^2)^(-3/2); both have their singularity at |y| = 1.
/// On an angular map the angle is pi times the distance from the centre, which counts in y_lm and once in the density.
Growth growthOf(MapLayout layout, int order) {
  if (layout == MapLayout::angular) return trigonometricGrowth(pi * order);
  return {[order](double y) { return (order - 1) * std::atanh(y) - 1.5 * std::log1p(-y * y); }, 1};
}

/// The width in pixels, a power of two, of tiles that make the work a pixel least: 3 multiplications a node of a row,
/// and y_lm with its sums once a node of the tile, which counts as 50 + 3 order^2.
int bestTileWidth(const Growth& growth, double cell, int size, int order) {
  int best = 1;
  double least = HUGE_VAL;
  for (int width = 1; width <= std::min(kMaxTile, size); width *= 2) {
    const int n = width == 1 ? gaussNodes(growth, cell) : interpolationNodes(growth, width * cell);
    const double nodesPerPixel = static_cast<double>(n) / width;
    const double cost = 3.0 * n + nodesPerPixel * nodesPerPixel * (50 + 3.0 * order * order);
    if (cost < least) {
      least = cost;
      best = width;
    }
  }
  return best;
}

/// The integral over [low, high] of the polynomial that is 1 in nodes[which] and 0 in the others.
double lagrangeIntegral(const std::vector<double>& nodes, std::size_t which, double low, double high,
                        const sh::IntervalRule& rule) {
  double sum = 0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const double x = low + (high - low) * (1 + rule.nodes[k]) / 2;
    double value = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != which) value *= (x - nodes[j]) / (nodes[which] - nodes[j]);
    }
    sum += rule.weights[k] * (high - low) / 2 * value;
  }
  return sum;
}

}  // namespace

/// A rectangle in chart coordinates: s rightwards and t upwards, both -1..1.
struct ChartProjector::Area {
  double s0, s1, t0, t1;

  double farthest() const {
    return std::hypot(std::max(std::abs(s0), std::abs(s1)), std::max(std::abs(t0), std::abs(t1)));
  }
  double nearest() const {
    const double s = s0 > 0 ? s0 : s1 < 0 ? s1 : 0, t = t0 > 0 ? t0 : t1 < 0 ? t1 : 0;
    return std::hypot(s, t);
  }
};

/// A chart and where to find its pixels in the rows at hand.
struct ChartProjector::View {
  const CubeFace& chart;
  const Rgb* pixels;  ///< row `firstRow` of the chart, at its left edge
  int firstRow;
  int stride;

  const Rgb* row(int y) const { return pixels + static_cast<std::size_t>(y - firstRow) * stride; }
};

struct ChartProjector::Scratch {
  std::vector<double> y;
  std::span<Vec3d> sum;
};

ChartProjector::ChartProjector(const MapShape& shape, int order) : shape_(shape), order_(order) {
  const bool angular = shape.layout == MapLayout::angular;
  if (angular) shape_.border = false;
  charts_ = mapCharts(shape.layout, shape.width, shape.height);
  size_ = charts_[0].size;
  if (shape_.border && size_ < 2) {
    throw Error({.place = "header", .cause = "a map with pixels on its edge needs 2 pixels across a face"});
  }

  const Growth growth = growthOf(shape.layout, order);
  const double cell = 1.0 / (shape_.border ? size_ - 1 : size_);  // half the width of a pixel
  const int widest = bestTileWidth(growth, cell, size_, order);
  tables_.resize(widest);
  tables_[0] = makeCellTable(growth, cell);
  const std::vector<int> cut = cuts();
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) addTables(growth, cell, cut[i + 1] - cut[i]);
  // Along the rim the ends of the inner integral move with the outer variable, at most as fast as it does, and are
  // smooth up to a distance of a quarter.
  if (angular) {
    const Growth rim{[&](double y) { return 2 * growth.exponent(y); }, 0.25};
    rimRule_ = sh::gaussLegendre(gaussNodes(rim, cell));
  }
}

/// The table for tiles `width` pixels wide, and where tiles are divided at the rim, for their parts.
void ChartProjector::addTables(const Growth& growth, double cell, int width) {
  if (!tables_[width - 1].nodes.empty()) return;
  tables_[width - 1] = makeTable(growth, width * cell, width);
  if (shape_.layout != MapLayout::angular) return;
  addTables(growth, cell, width / 2);
  addTables(growth, cell, width - width / 2);
}

ChartProjector::TileTable ChartProjector::makeCellTable(const Growth& growth, double halfLength) {
  const sh::IntervalRule rule = sh::gaussLegendre(gaussNodes(growth, halfLength));
  return {rule.nodes, rule.weights};
}

ChartProjector::TileTable ChartProjector::makeTable(const Growth& growth, double halfLength, int width) {
  TileTable table;
  table.nodes = sh::gaussLegendre(interpolationNodes(growth, halfLength)).nodes;
  const int n = static_cast<int>(table.nodes.size());
  const sh::IntervalRule exact = sh::gaussLegendre((n + 1) / 2);
  for (int cell = 0; cell < width; ++cell) {
    const double low = -1 + 2.0 * cell / width, high = -1 + 2.0 * (cell + 1) / width;
    for (int a = 0; a < n; ++a) table.integrals.push_back(lagrangeIntegral(table.nodes, a, low, high, exact));
  }
  return table;
}

/// Where pixel i of a chart begins, in -1..1.
double ChartProjector::edge(int i) const {
  if (!shape_.border) return -1 + 2.0 * i / size_;
  return -1 + 2 * std::clamp((i - 0.5) / (size_ - 1), 0.0, 1.0);
}

ChartProjector::Area ChartProjector::areaOf(const Tile& tile) const {
  return {edge(tile.x0), edge(tile.x1), -edge(tile.y1), -edge(tile.y0)};
}

/// Where tiles begin along a chart, and its end. Pixels on a border have half the width and tiles of their own.
std::vector<int> ChartProjector::cuts() const {
  std::vector<int> cuts{0};
  const int first = shape_.border ? 1 : 0, last = shape_.border ? size_ - 1 : size_;
  for (int at = first; at < last; at += static_cast<int>(tables_.size())) {
    if (at > 0) cuts.push_back(at);
  }
  if (last < size_) cuts.push_back(last);
  cuts.push_back(size_);
  return cuts;
}

std::vector<RowStrip> ChartProjector::strips() const {
  std::vector<int> tops;
  for (const CubeFace& chart : charts_) tops.push_back(chart.y);
  std::sort(tops.begin(), tops.end());
  tops.erase(std::unique(tops.begin(), tops.end()), tops.end());
  const std::vector<int> rows = cuts();
  std::vector<RowStrip> strips;
  for (const int top : tops) {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) strips.push_back({top + rows[i], top + rows[i + 1]});
  }
  return strips;
}

void ChartProjector::project(const RowStrip& strip, std::span<const Rgb> pixels, std::span<Vec3d> sum) const {
  Scratch scratch{std::vector<double>(sum.size()), sum};
  const std::vector<int> columns = cuts();
  for (const CubeFace& chart : charts_) {
    if (strip.begin < chart.y || strip.begin >= chart.y + size_) continue;
    const int top = strip.begin - chart.y, bottom = strip.end - chart.y;
    const View view{chart, pixels.data() + chart.x, top, shape_.width};
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const Tile tile{columns[i], columns[i + 1], top, bottom};
      if (shape_.layout == MapLayout::angular) {
        addClipped(view, tile, scratch);
      } else {
        addTile(view, tile, scratch);
      }
    }
  }
}

/// Adds the tile to the sum: colours meet the polynomials of their column, then of their row, then y_lm in the nodes.
void ChartProjector::addTile(const View& view, const Tile& tile, Scratch& scratch) const {
  const TileTable& across = tables_[tile.x1 - tile.x0 - 1];
  const TileTable& down = tables_[tile.y1 - tile.y0 - 1];
  const std::size_t na = across.nodes.size(), nb = down.nodes.size();
  std::vector<double> red(na), green(na), blue(na);
  std::vector<Vec3d> moments(na * nb);
  for (int y = tile.y0; y < tile.y1; ++y) {
    std::fill(red.begin(), red.end(), 0);
    std::fill(green.begin(), green.end(), 0);
    std::fill(blue.begin(), blue.end(), 0);
    const Rgb* row = view.row(y);
    for (int x = tile.x0; x < tile.x1; ++x) {
      const double* factors = &across.integrals[(x - tile.x0) * na];
      const Vec3d p(row[x]);
      for (std::size_t a = 0; a < na; ++a) {
        red[a] += factors[a] * p.x;
        green[a] += factors[a] * p.y;
        blue[a] += factors[a] * p.z;
      }
    }
    const double* factors = &down.integrals[(y - tile.y0) * nb];
    for (std::size_t b = 0; b < nb; ++b) {
      for (std::size_t a = 0; a < na; ++a) moments[b * na + a] += factors[b] * Vec3d{red[a], green[a], blue[a]};
    }
  }
  const Area area = areaOf(tile);
  const double halfWidth = (area.s1 - area.s0) / 2, halfHeight = (area.t1 - area.t0) / 2;
  for (std::size_t b = 0; b < nb; ++b) {
    // Rows go down while t goes up.
    const double t = area.t1 - halfHeight * (1 + down.nodes[b]);
    for (std::size_t a = 0; a < na; ++a) {
      const double s = area.s0 + halfWidth * (1 + across.nodes[a]);
      addPoint(view.chart, s, t, halfWidth * halfHeight * moments[b * na + a], scratch);
    }
  }
}

/// Adds `weight` times the solid angle per area times y_lm in the direction of the chart's point (s, t).
void ChartProjector::addPoint(const CubeFace& chart, double s, double t, const Vec3d& weight, Scratch& scratch) const {
  Vec3d direction;
  double density;
  if (shape_.layout == MapLayout::angular) {
    const double r = std::hypot(s, t), angle = pi * r, slope = r > 0 ? std::sin(angle) / r : pi;
    direction = std::cos(angle) * chart.forward + slope * (s * chart.right + t * chart.up);
    density = pi * slope;
  } else {
    const double inverse = 1 / std::sqrt(1 + s * s + t * t);
    direction = inverse * (chart.forward + s * chart.right + t * chart.up);
    density = inverse * inverse * inverse;
  }
  sh::evaluate(order_, direction, scratch.y);
  const Vec3d color = density * weight;
  for (std::size_t i = 0; i < scratch.y.size(); ++i) scratch.sum[i] += scratch.y[i] * color;
}

/// Adds the part of the tile that lies within the circle of an angular map.
void ChartProjector::addClipped(const View& view, const Tile& tile, Scratch& scratch) const {
  const Area area = areaOf(tile);
  const int width = tile.x1 - tile.x0, height = tile.y1 - tile.y0;
  if (area.farthest() <= 1) {
    addTile(view, tile, scratch);
  } else if (area.nearest() >= 1) {
    return;
  } else if (width == 1 && height == 1) {
    addRimPixel(view, tile, scratch);
  } else if (width >= height) {
    const int middle = tile.x0 + width / 2;
    addClipped(view, {tile.x0, middle, tile.y0, tile.y1}, scratch);
    addClipped(view, {middle, tile.x1, tile.y0, tile.y1}, scratch);
  } else {
    const int middle = tile.y0 + height / 2;
    addClipped(view, {tile.x0, tile.x1, tile.y0, middle}, scratch);
    addClipped(view, {tile.x0, tile.x1, middle, tile.y1}, scratch);
  }
}

/// Adds the part of one pixel that lies within the circle. The outer variable is the one along which the circle is
/// flatter; between the places where it enters or leaves the pixel, the ends of the inner integral are smooth.
void ChartProjector::addRimPixel(const View& view, const Tile& tile, Scratch& scratch) const {
  const Vec3d color(view.row(tile.y0)[tile.x0]);
  const Area area = areaOf(tile);
  const bool outerIsS = std::abs(area.s0 + area.s1) < std::abs(area.t0 + area.t1);
  const double o0 = outerIsS ? area.s0 : area.t0, o1 = outerIsS ? area.s1 : area.t1;
  const double i0 = outerIsS ? area.t0 : area.s0, i1 = outerIsS ? area.t1 : area.s1;

  std::vector<double> breaks{o0, o1};
  for (const double inner : {i0, i1}) {
    const double crossing = std::sqrt(std::max(0.0, (1 - inner) * (1 + inner)));
    for (const double at : {-crossing, crossing}) {
      if (at > o0 && at < o1) breaks.push_back(at);
    }
  }
  std::sort(breaks.begin(), breaks.end());

  const auto& [nodes, weights] = rimRule_;
  for (std::size_t piece = 0; piece + 1 < breaks.size(); ++piece) {
    const double low = breaks[piece], half = (breaks[piece + 1] - low) / 2;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const double outer = low + half * (1 + nodes[a]);
      const double chord = std::sqrt(std::max(0.0, (1 - outer) * (1 + outer)));
      const double from = std::max(i0, -chord), halfChord = (std::min(i1, chord) - from) / 2;
      if (halfChord <= 0) continue;
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        const double inner = from + halfChord * (1 + nodes[b]);
        const Vec3d weight = weights[a] * weights[b] * half * halfChord * color;
        addPoint(view.chart, outerIsS ? outer : inner, outerIsS ? inner : outer, weight, scratch);
      }
    }
  }
}

}  // namespace shbake
