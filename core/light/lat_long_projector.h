// Lat-long maps: a Fourier sum along each row, then Legendre functions from row to row.
#pragma once

#include "light/map_projector.h"
#include "sh/quadrature.h"

namespace shbake {

/// Costs 2 order - 1 multiplications a pixel and channel, half of that for an even width. Sums are double: coefficients
/// of a constant map are exact to 1e-14.
class LatLongProjector : public MapProjector {
 public:
  /// Throws an Error without a file name for an image too small to have the border it claims.
  LatLongProjector(const MapShape& shape, int order);

  std::vector<RowStrip> strips() const override;
  void project(const RowStrip& strip, std::span<const Rgb> pixels, std::span<Vec3d> sum) const override;

 private:
  struct Moments;

  void addRowMoments(const Rgb* row, Moments& moments) const;
  void addRow(int row, const Moments& moments, std::span<Vec3d> sum) const;
  double rowEdge(int i) const;

  MapShape shape_;
  int order_;
  int columns_;                          ///< cells around the circle
  int half_;                             ///< columns_ / 2 where the halves are folded onto each other, else columns_
  sh::IntervalRule rule_;                ///< across a row
  std::vector<double> cosines_, sines_;  ///< cos m phi_j at [m half_ + j], j < half_
};

}  // namespace shbake
