// Cube maps and angular maps: squares of pixels on which direction is a smooth function of place.
#pragma once

#include "light/chart_sum.h"
#include "light/map_projector.h"
#include "light/quadrature_size.h"
#include "light/tile_table.h"
#include "sh/quadrature.h"

namespace shbake {

/// The map is cut into tiles of up to 64 x 64 pixels. On a tile, y_lm times the solid angle per area is interpolated
/// from a few nodes, and the integrals of the interpolating polynomials over each pixel are tabulated: a pixel costs
/// about eight multiplications a channel, and y_lm is evaluated at the nodes alone. The rim of an angular map is cut
/// exactly. Tiles that are each other's mirror images, left and right, share their nodes.
class ChartProjector : public MapProjector {
 public:
  /// Throws an Error without a file name when the shape does not fit the layout (mapCharts()).
  ChartProjector(const MapShape& shape, int order);

  std::vector<RowStrip> strips() const override;
  void project(const RowStrip& strip, std::span<const Rgb> pixels, std::span<Vec3d> sum) const override;

 private:
  /// A rectangle of pixels of one chart.
  struct Tile {
    int x0, x1, y0, y1;
  };
  /// Pixels first..last-1 of a row.
  struct Stretch {
    int first, last;
  };
  struct Area;
  struct View;
  struct Side;
  struct Scratch;

  Area areaOf(const Tile& tile) const;
  Tile mirrored(const Tile& tile) const;
  std::vector<int> cuts() const;
  void addTile(const View& view, const Tile& tile, bool isPaired, Scratch& scratch, ChartSum& sum) const;
  void takeRows(const View& view, const Tile& tile, Side& side) const;
  bool takeWithinRim(const View& view, const Tile& tile, bool isPaired, Scratch& scratch, ChartSum& sum) const;
  void findMoments(const Tile& tile, Scratch& scratch, Side& side) const;
  void addNodes(const Tile& tile, bool isPaired, const Scratch& scratch, ChartSum& sum) const;
  Stretch stretchOf(const Tile& tile, int y, double (Area::*distance)() const) const;
  void addRimPixel(const Area& area, const Vec3d& color, const Vec3d* mirroredColor, ChartSum& sum) const;

  MapShape shape_;
  int order_;
  int size_;                       ///< pixels across a chart
  std::vector<double> edges_;      ///< where the pixels of a chart begin, -1..1, and the end
  std::vector<CubeFace> charts_;   ///< six faces, or the one square of an angular map
  std::vector<TileTable> tables_;  ///< of tiles 1, 2, ... pixels wide, without nodes where no tile is
  sh::IntervalRule rimRule_;       ///< for pixels that the rim of an angular map cuts
};

}  // namespace shbake
