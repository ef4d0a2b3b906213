// Integrals over the pixels of cube faces and angular maps, by interpolation in Gauss-Legendre nodes: on one pixel this
// is Gauss-Legendre quadrature, on a tile it shares the evaluations among its pixels.
#include "light/chart_projector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ranges>

#include "base/error.h"

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

/// The width in pixels, a power of two, of tiles that make the work a pixel least: half a multiplication a node of a
/// column in three channels, the same for each node of a column along rows, and y_lm with its sums once a node of the
/// tile, which counts as 50 + 3 order^2.
int bestTileWidth(const Growth& growth, double cell, int size, int order) {
  int best = 1;
  double least = HUGE_VAL;
  for (int width = 1; width <= std::min(kMaxTile, size); width *= 2) {
    const int n = width == 1 ? gaussNodes(growth, cell) : interpolationNodes(growth, width * cell);
    const double nodesPerPixel = static_cast<double>(n) / width;
    const double cost = 1.5 * n * (1 + nodesPerPixel) + nodesPerPixel * nodesPerPixel * (50 + 3.0 * order * order);
    if (cost < least) {
      least = cost;
      best = width;
    }
  }
  return best;
}

}  // namespace

/// A rectangle in chart coordinates: s rightwards and t upwards, both -1..1.
struct ChartProjector::Area {
  double s0, s1, t0, t1;

  /// Squared distances from the centre.
  double farthest() const {
    const double s = std::max(std::abs(s0), std::abs(s1)), t = std::max(std::abs(t0), std::abs(t1));
    return s * s + t * t;
  }
  double nearest() const {
    const double s = s0 > 0 ? s0 : s1 < 0 ? s1 : 0, t = t0 > 0 ? t0 : t1 < 0 ? t1 : 0;
    return s * s + t * t;
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

/// A tile or its mirror image.
struct ChartProjector::Side {
  std::vector<const float*> rows;  ///< of the tile's pixels
  std::vector<Rgb> masked;         ///< the tile's pixels, black where they do not count
  std::vector<double> moments;     ///< [node across][node down][channel]
};

struct ChartProjector::Scratch {
  Side left, right;
  TileTable::Scratch table;
  std::vector<double> columnMoments;   ///< [node down][column][channel]
  std::vector<double> turned;          ///< the same as [column][node down][channel]
  std::vector<const double*> columns;  ///< of `turned`
};

ChartProjector::ChartProjector(const MapShape& shape, int order) : shape_(shape), order_(order) {
  const bool angular = shape.layout == MapLayout::angular;
  if (angular) shape_.border = false;
  charts_ = mapCharts(shape.layout, shape.width, shape.height);
  size_ = charts_[0].size;
  if (shape_.border && size_ < 2) {
    throw Error({.place = "header", .cause = "a map with pixels on its edge needs 2 pixels across a face"});
  }

  for (int i = 0; i <= size_; ++i) {
    const double begin = shape_.border ? std::clamp((i - 0.5) / (size_ - 1), 0.0, 1.0) : static_cast<double>(i) / size_;
    edges_.push_back(-1 + 2 * begin);
  }
  const Growth growth = growthOf(shape.layout, order);
  const double cell = 1.0 / (shape_.border ? size_ - 1 : size_);  // half the width of a pixel
  const int widest = bestTileWidth(growth, cell, size_, order);
  tables_.resize(widest);
  tables_[0] = TileTable(sh::gaussLegendre(gaussNodes(growth, cell)).nodes, 1);
  const std::vector<int> cut = cuts();
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    const int width = cut[i + 1] - cut[i];
    TileTable& table = tables_[width - 1];
    if (table.nodes().empty()) {
      table = TileTable(sh::gaussLegendre(interpolationNodes(growth, width * cell)).nodes, width);
    }
  }
  // Along the rim the ends of the inner integral move with the outer variable, at most as fast as it does, and are
  // smooth up to a distance of a quarter.
  if (angular) {
    const Growth rim{[&](double y) { return 2 * growth.exponent(y); }, 0.25};
    rimRule_ = sh::gaussLegendre(gaussNodes(rim, cell));
  }
}

ChartProjector::Area ChartProjector::areaOf(const Tile& tile) const {
  return {edges_[tile.x0], edges_[tile.x1], -edges_[tile.y1], -edges_[tile.y0]};
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

/// The tile at the other end of its rows.
ChartProjector::Tile ChartProjector::mirrored(const Tile& tile) const {
  return {size_ - tile.x1, size_ - tile.x0, tile.y0, tile.y1};
}

void ChartProjector::project(const RowStrip& strip, std::span<const Rgb> pixels, std::span<Vec3d> sum) const {
  Scratch scratch;
  const std::vector<int> columns = cuts();
  const auto isCut = [&](int x) { return std::binary_search(columns.begin(), columns.end(), x); };
  for (const CubeFace& chart : charts_) {
    if (strip.begin < chart.y || strip.begin >= chart.y + size_) continue;
    const int top = strip.begin - chart.y, bottom = strip.end - chart.y;
    const View view{chart, pixels.data() + chart.x, top, shape_.width};
    ChartSum points(shape_.layout, chart, order_, sum);
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const Tile tile{columns[i], columns[i + 1], top, bottom}, other = mirrored(tile);
      const bool isPaired = tile.x0 != other.x0 && isCut(other.x0) && isCut(other.x1);
      if (!isPaired || tile.x0 < other.x0) addTile(view, tile, isPaired, scratch, points);
    }
    points.flush();
  }
}

/// Adds the tile, and its mirror image where they are a pair. Of an angular map, what lies within the circle: whole
/// pixels together, as y_lm and the solid angle go on smoothly beyond the rim, and those that the rim cuts one by one.
void ChartProjector::addTile(const View& view, const Tile& tile, bool isPaired, Scratch& scratch, ChartSum& sum) const {
  const Area area = areaOf(tile);
  const bool angular = shape_.layout == MapLayout::angular;
  if (angular && area.nearest() >= 1) return;
  if (angular && area.farthest() > 1) {
    if (!takeWithinRim(view, tile, isPaired, scratch, sum)) return;
  } else {
    takeRows(view, tile, scratch.left);
    if (isPaired) takeRows(view, mirrored(tile), scratch.right);
  }
  findMoments(tile, scratch, scratch.left);
  if (isPaired) findMoments(mirrored(tile), scratch, scratch.right);
  addNodes(tile, isPaired, scratch, sum);
}

void ChartProjector::takeRows(const View& view, const Tile& tile, Side& side) const {
  side.rows.clear();
  for (int y = tile.y0; y < tile.y1; ++y) side.rows.push_back(&view.row(y)[tile.x0].x);
}

/// Finds the moments of the colours of a tile with the polynomials of their row, then of their column.
void ChartProjector::findMoments(const Tile& tile, Scratch& scratch, Side& side) const {
  const TileTable& across = tables_[tile.x1 - tile.x0 - 1];
  const TileTable& down = tables_[tile.y1 - tile.y0 - 1];
  const int na = static_cast<int>(across.nodes().size()), nb = static_cast<int>(down.nodes().size());
  const int width = tile.x1 - tile.x0, stride = 3 * nb;
  scratch.columnMoments.resize(static_cast<std::size_t>(stride) * width);
  down.contract<float>(side.rows, 3 * width, scratch.columnMoments, scratch.table);

  scratch.turned.resize(scratch.columnMoments.size());
  scratch.columns.clear();
  for (int x = 0; x < width; ++x) {
    double* const column = &scratch.turned[static_cast<std::size_t>(x) * stride];
    scratch.columns.push_back(column);
    for (int b = 0; b < nb; ++b) std::copy_n(&scratch.columnMoments[(b * width + x) * 3], 3, column + 3 * b);
  }
  side.moments.resize(static_cast<std::size_t>(stride) * na);
  across.contract<double>(scratch.columns, stride, side.moments, scratch.table);
}

/// Adds the nodes of the tile, each with its mirror image.
void ChartProjector::addNodes(const Tile& tile, bool isPaired, const Scratch& scratch, ChartSum& sum) const {
  const std::vector<double>& across = tables_[tile.x1 - tile.x0 - 1].nodes();
  const std::vector<double>& down = tables_[tile.y1 - tile.y0 - 1].nodes();
  const Area area = areaOf(tile);
  const double halfWidth = (area.s1 - area.s0) / 2, halfHeight = (area.t1 - area.t0) / 2;
  const auto moment = [&](const Side& side, std::size_t a, std::size_t b) {
    const double* m = &side.moments[3 * (a * down.size() + b)];
    return halfWidth * halfHeight * Vec3d{m[0], m[1], m[2]};
  };
  for (std::size_t b = 0; b < down.size(); ++b) {
    // Rows go down while t goes up.
    const double t = area.t1 - halfHeight * (1 + down[b]);
    for (std::size_t a = 0; a < across.size(); ++a) {
      const double s = area.s0 + halfWidth * (1 + across[a]);
      if (isPaired) {
        sum.addPair(s, t, moment(scratch.left, a, b), moment(scratch.right, across.size() - 1 - a, b));
      } else {
        sum.add(s, t, moment(scratch.left, a, b));
      }
    }
  }
}

/// Takes the whole pixels of a tile that the rim crosses, the others as black, and adds those that are cut. Returns
/// whether there are whole ones.
bool ChartProjector::takeWithinRim(const View& view, const Tile& tile, bool isPaired, Scratch& scratch,
                                   ChartSum& sum) const {
  const int width = tile.x1 - tile.x0;
  const auto clear = [&](Side& side) {
    side.rows.clear();
    side.masked.assign(static_cast<std::size_t>(width) * (tile.y1 - tile.y0), Rgb{});
    for (int y = 0; y < tile.y1 - tile.y0; ++y)
      side.rows.push_back(&side.masked[static_cast<std::size_t>(y) * width].x);
  };
  clear(scratch.left);
  if (isPaired) clear(scratch.right);
  bool any = false;
  for (int y = tile.y0; y < tile.y1; ++y) {
    const Rgb* const row = view.row(y);
    const std::size_t at = static_cast<std::size_t>(y - tile.y0) * width;
    const Stretch touched = stretchOf(tile, y, &Area::nearest), whole = stretchOf(tile, y, &Area::farthest);
    const auto addRim = [&](int first, int last) {
      for (int x = first; x < last; ++x) {
        const Vec3d color(row[x]), other(row[size_ - 1 - x]);
        addRimPixel(areaOf({x, x + 1, y, y + 1}), color, isPaired ? &other : nullptr, sum);
      }
    };
    addRim(touched.first, whole.first);
    addRim(whole.last, touched.last);
    if (whole.first == whole.last) continue;
    any = true;
    std::copy(row + whole.first, row + whole.last, &scratch.left.masked[at + (whole.first - tile.x0)]);
    if (isPaired) {
      std::copy(row + (size_ - whole.last), row + (size_ - whole.first),
                &scratch.right.masked[at + (tile.x1 - whole.last)]);
    }
  }
  return any;
}

/// The pixels of row y of a tile whose squared distance, the nearest or the farthest, is below 1: those that the circle
/// touches, or that lie within it as a whole. They follow each other; empty stretches lie where the circle is nearest.
ChartProjector::Stretch ChartProjector::stretchOf(const Tile& tile, int y, double (Area::*distance)() const) const {
  const auto isWithin = [&](int x) { return (areaOf({x, x + 1, y, y + 1}).*distance)() < 1; };
  const int innermost = std::clamp(size_ / 2, tile.x0, tile.x1 - 1);
  if (!isWithin(innermost)) return {innermost, innermost};
  // Distances rise from the innermost pixel to both sides.
  const auto from = std::views::iota(tile.x0, innermost), to = std::views::iota(innermost + 1, tile.x1);
  const auto first = std::partition_point(from.begin(), from.end(), [&](int x) { return !isWithin(x); });
  const auto last = std::partition_point(to.begin(), to.end(), isWithin);
  return {first == from.end() ? innermost : *first, last == to.end() ? tile.x1 : *last};
}

/// Adds the part of one pixel that lies within the circle. The outer variable is the one along which the circle is
/// flatter; between the places where it enters or leaves the pixel, the ends of the inner integral are smooth.
void ChartProjector::addRimPixel(const Area& area, const Vec3d& color, const Vec3d* mirroredColor,
                                 ChartSum& sum) const {
  const bool outerIsS = std::abs(area.s0 + area.s1) < std::abs(area.t0 + area.t1);
  const double o0 = outerIsS ? area.s0 : area.t0, o1 = outerIsS ? area.s1 : area.t1;
  const double i0 = outerIsS ? area.t0 : area.s0, i1 = outerIsS ? area.t1 : area.s1;

  std::array<double, 6> breaks{o0};
  std::size_t count = 1;
  for (const double inner : {i0, i1}) {
    const double crossing = std::sqrt(std::max(0.0, (1 - inner) * (1 + inner)));
    for (const double at : {-crossing, crossing}) {
      if (at > o0 && at < o1) breaks[count++] = at;
    }
  }
  breaks[count] = o1;
  std::sort(breaks.begin(), breaks.begin() + static_cast<std::ptrdiff_t>(count));

  const auto& [nodes, weights] = rimRule_;
  for (std::size_t piece = 0; piece < count; ++piece) {
    const double low = breaks[piece], half = (breaks[piece + 1] - low) / 2;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const double outer = low + half * (1 + nodes[a]);
      const double chord = std::sqrt(std::max(0.0, (1 - outer) * (1 + outer)));
      const double from = std::max(i0, -chord), halfChord = (std::min(i1, chord) - from) / 2;
      if (halfChord <= 0) continue;
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        const double inner = from + halfChord * (1 + nodes[b]), weight = weights[a] * weights[b] * half * halfChord;
        const double s = outerIsS ? outer : inner, t = outerIsS ? inner : outer;
        if (mirroredColor != nullptr) {
          sum.addPair(s, t, weight * color, weight * *mirroredColor);
        } else {
          sum.add(s, t, weight * color);
        }
      }
    }
  }
}

}  // namespace shbake
