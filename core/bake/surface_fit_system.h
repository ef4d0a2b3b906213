// The linear system behind a fit of vertex values to samples of the surface.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Corrections D of vertex values that bring what is interpolated nearest to samples of the surface:
///   (G + mu M) D = sum of w b r,   G = sum of w b b^T,
/// with the weight w, the interpolation weights b and the residual r of each sample, and M the row sums of G (maths.md
/// (30)). For each vertex the ridge mu sets how many times the mass of its samples its own value weighs; a vertex
/// without samples stays.
class SurfaceFitSystem {
 public:
  /// `faces` are triples of unknowns 0..unknowns-1 and must outlive the object; `columns` values are fitted at once.
  /// Memory: 8 bytes for each unknown and column, and about 300 for each unknown.
  SurfaceFitSystem(std::size_t unknowns, const std::vector<Triangle>& faces, std::size_t columns);

  /// Adds a sample on a face: the weights of its corners, its own weight (0 or more), and `columns` residuals.
  void add(std::size_t face, const std::array<double, 3>& corners, double weight, std::span<const double> residual);

  /// The corrections, a row of `columns` values for each unknown, for a ridge above 0: to 1e-6 of the largest in the
  /// norm of each column. Progress counts columns.
  std::vector<float> solve(double ridge, const Parallel& parallel, Progress& progress) const;

 private:
  const std::vector<Triangle>& faces_;
  std::size_t unknowns_, columns_;
  std::vector<std::array<double, 6>> faceSums_;  // of w b b^T: the diagonal, then corners 01, 12, 20
  std::vector<double> right_;
};

}  // namespace shbake
