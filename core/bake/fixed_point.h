// Solving x = g(x) for a contraction g, column by column.
//
// D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12 (1965); in the form of H. F.
// Walker, P. Ni, "Anderson acceleration for fixed-point iterations", SIAM J. Numer. Anal. 49 (2011).
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"

namespace shbake {

struct FixedPointOptions {
  double tolerance = 1e-3;  ///< 2-norm of each column's error at which it counts as solved
  int maxSteps = 1000;      ///< evaluations of g at most
};

struct FixedPointResult {
  int steps = 0;           ///< evaluations of g
  bool converged = false;  ///< every column's error estimate met the tolerance
};

/// Evaluations of g whose points are remembered: memory is 2 * kFixedPointWindow arrays.
inline constexpr int kFixedPointWindow = 3;

/// Solves for `rows` x `columns` floats, row by row, from the start in `x`, which holds the result afterwards.
/// map(in, out) evaluates g. Columns are independent problems: each has its own coefficients, so that its result does
/// not depend on which others are solved beside it. The error of a column is estimated as its residual times the
/// largest ratio |x_i - x_j| / |f_i - f_j| seen, a lower bound of the inverse's norm that the slow modes soon make
/// sharp. `progress` only cancels: it counts nothing.
FixedPointResult solveFixedPoint(std::size_t rows, std::size_t columns, std::vector<float>& x,
                                 const std::function<void(const float* in, float* out)>& map,
                                 const FixedPointOptions& options, const Parallel& parallel, Progress& progress);

}  // namespace shbake
