#include "bake/fixed_point.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace shbake {
namespace {

constexpr std::size_t kWindow = kFixedPointWindow;
constexpr std::size_t kBlock = 4096;
/// Relative size of the diagonal added to the normal equations: drops directions that rounding alone tells apart.
constexpr double kRidge = 1e-10;

constexpr int kMost = kFixedPointWindow - 1;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;

/// A point of the iteration and where g takes it; f = gx - x is its residual.
struct Iterate {
  std::vector<float> x, gx;
};

/// Products of residuals over all rows, a set for each column.
struct Products {
  std::array<std::array<double, kWindow>, kWindow> f{};  // f_i . f_j
  double dx = 0;                                         // |x_newest - x_previous|^2
};

class Solver {
 public:
  Solver(std::size_t rows, std::size_t columns, const Parallel& parallel, Progress& progress)
      : rows_(rows),
        columns_(columns),
        parallel_(parallel),
        progress_(progress),
        products_(columns),
        slowness_(columns, 1.0),
        settled_(columns, 0),
        held_(columns, 0) {}

  /// Takes up the newest evaluation.
  void add(Iterate iterate) {
    window_.push_back(std::move(iterate));
    held_ = settled_;
    multiplyNewest();
  }

  /// Whether column k is solved, now or earlier. From then on it is held, whatever the others still need: further steps
  /// would make its result depend on them. The first residuals alone tell nothing about the error: where g hardly
  /// contracts, as between white walls around a small hole, they are small however far the solution.
  bool settle(std::size_t k, double tolerance) {
    if (!settled_[k]) settled_[k] = error(k) <= (window_.size() == kWindow ? tolerance : 0);
    return settled_[k] != 0;
  }

  /// The next point, the combination of gx with the least combined residual, and room for where g takes it. Both are
  /// in the memory of the oldest evaluation where the window is full, which drops it.
  Iterate next() {
    if (window_.size() < kWindow) {
      Iterate fresh{std::vector<float>(rows_ * columns_), std::vector<float>(rows_ * columns_)};
      combine(fresh.x);
      return fresh;
    }
    combine(window_.front().gx);
    Iterate oldest = dropOldest();
    return {std::move(oldest.gx), std::move(oldest.x)};
  }

  /// The newest values of all columns; the window is of no use afterwards.
  std::vector<float> takeNewest() {
    std::vector<float> values = std::move(window_.back().gx);
    for (std::size_t k = 0; k < columns_; ++k) {
      for (std::size_t e = k; held_[k] && e < values.size(); e += columns_) values[e] = window_.back().x[e];
    }
    return values;
  }

 private:
  /// Writes the next point to `out`, which may be the gx of an evaluation: no value depends on another's place.
  void combine(std::vector<float>& out) const {
    std::vector<std::array<double, kWindow>> weights(columns_);
    for (std::size_t k = 0; k < columns_; ++k) weights[k] = leastResidual(products_[k].f);
    parallel_.forBlocks(rows_, kBlock, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t r = begin; r < end; ++r) {
        for (std::size_t k = 0; k < columns_; ++k) {
          const std::size_t e = r * columns_ + k;
          if (settled_[k]) {
            out[e] = newest(e, k);
            continue;
          }
          double value = 0;
          for (std::size_t i = 0; i < window_.size(); ++i) {
            value += weights[k][i] * static_cast<double>(window_[i].gx[e]);
          }
          out[e] = static_cast<float>(value);
        }
      }
      progress_.advance(0);
    });
  }

  Iterate dropOldest() {
    Iterate oldest = std::move(window_.front());
    window_.erase(window_.begin());
    for (Products& p : products_) {
      for (std::size_t i = 0; i + 1 < kWindow; ++i) {
        for (std::size_t j = 0; j + 1 < kWindow; ++j) p.f[i][j] = p.f[i + 1][j + 1];
      }
    }
    return oldest;
  }

  /// The estimated error of column k's newest evaluation.
  double error(std::size_t k) {
    const std::size_t n = window_.size() - 1;
    const auto& f = products_[k].f;
    if (n > 0) {
      const double df = f[n][n] - 2 * f[n][n - 1] + f[n - 1][n - 1];
      if (df > 0) slowness_[k] = std::max(slowness_[k], std::sqrt(products_[k].dx / df));
    }
    return slowness_[k] * std::sqrt(std::max(0.0, f[n][n]));
  }

  /// Element e, of column k: where g takes it, or where it was when the column was solved.
  float newest(std::size_t e, std::size_t k) const { return held_[k] ? window_.back().x[e] : window_.back().gx[e]; }

  /// Products of the newest residual with all, summed block by block in a fixed order.
  void multiplyNewest() {
    const std::size_t n = window_.size() - 1, blocks = (rows_ + kBlock - 1) / kBlock;
    const std::size_t width = (kWindow + 1) * columns_;
    std::vector<double> partial(blocks * width);
    parallel_.forBlocks(rows_, kBlock, [&](std::size_t begin, std::size_t end, int) {
      double* sums = &partial[begin / kBlock * width];
      for (std::size_t e = begin * columns_; e < end * columns_; ++e) {
        double* s = sums + e % columns_ * (kWindow + 1);
        const auto residual = [&](std::size_t i) {
          return static_cast<double>(window_[i].gx[e]) - static_cast<double>(window_[i].x[e]);
        };
        const double newest = residual(n);
        for (std::size_t i = 0; i <= n; ++i) s[i] += newest * residual(i);
        const double dx = n > 0 ? static_cast<double>(window_[n].x[e]) - static_cast<double>(window_[n - 1].x[e]) : 0;
        s[kWindow] += dx * dx;
      }
      progress_.advance(0);
    });
    for (std::size_t k = 0; k < columns_; ++k) {
      Products& p = products_[k];
      std::array<double, kWindow + 1> sums{};
      for (std::size_t b = 0; b < blocks; ++b) {
        for (std::size_t i = 0; i <= kWindow; ++i) sums[i] += partial[b * width + k * (kWindow + 1) + i];
      }
      for (std::size_t i = 0; i <= n; ++i) p.f[i][n] = p.f[n][i] = sums[i];
      p.dx = sums[kWindow];
    }
  }

  /// Weights of sum 1 that minimise |sum w_i f_i|, from the products of the f_i.
  std::array<double, kWindow> leastResidual(const std::array<std::array<double, kWindow>, kWindow>& f) const {
    const std::size_t n = window_.size() - 1;
    const auto size = static_cast<Eigen::Index>(n);
    SmallMatrix differences(size, size);
    SmallVector towardsNewest(size);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      for (std::size_t j = 0; j < n; ++j) {
        differences(row, static_cast<Eigen::Index>(j)) = f[i][j] - f[i][n] - f[n][j] + f[n][n];
      }
      differences(row, row) *= 1 + kRidge;
      towardsNewest(row) = f[n][n] - f[i][n];
    }
    std::array<double, kWindow> w{};
    // A column that is solved exactly has no differences left: its newest value stands.
    const SmallVector best = differences.ldlt().solve(towardsNewest);
    for (std::size_t i = 0; i < n && best.allFinite(); ++i) w[i] = best(static_cast<Eigen::Index>(i));
    w[n] = 1;
    for (std::size_t i = 0; i < n; ++i) w[n] -= w[i];
    return w;
  }

  std::size_t rows_, columns_;
  const Parallel& parallel_;
  Progress& progress_;
  std::vector<Iterate> window_;
  std::vector<Products> products_;
  std::vector<double> slowness_;
  std::vector<std::uint8_t> settled_;  // columns that are solved
  std::vector<std::uint8_t> held_;     // columns that were solved before the newest evaluation: x has their result
};

}  // namespace

FixedPointResult solveFixedPoint(std::size_t rows, std::size_t columns, std::vector<float>& x,
                                 const std::function<void(const float* in, float* out)>& map,
                                 const FixedPointOptions& options, const Parallel& parallel, Progress& progress) {
  Solver solver(rows, columns, parallel, progress);
  FixedPointResult result;
  Iterate iterate{std::move(x), std::vector<float>(rows * columns)};
  while (true) {
    map(iterate.x.data(), iterate.gx.data());
    ++result.steps;
    solver.add(std::move(iterate));
    result.converged = true;
    for (std::size_t k = 0; k < columns; ++k) result.converged &= solver.settle(k, options.tolerance);
    if (result.converged || result.steps >= options.maxSteps) {
      x = solver.takeNewest();
      return result;
    }
    iterate = solver.next();
  }
}

}  // namespace shbake
