// Conjugate gradients with the diagonal as preconditioner (Hestenes, Stiefel, "Methods of conjugate gradients for
// solving linear systems", 1952). G is a mass matrix, whose eigenvalues relative to its row sums M lie in 0..1: those
// of G + mu M are within mu..1 + mu, so that k steps leave 2 ((sqrt(c) - 1) / (sqrt(c) + 1))^k with c = (1 + mu) / mu,
// whatever the size of the mesh (Wathen, "Realistic eigenvalue bounds for the Galerkin mass matrix", 1987). A
// factorisation would take more memory, could not be stopped, and would run on one thread.
#include "bake/surface_fit_system.h"

#include <algorithm>
#include <cmath>

namespace shbake {
namespace {

/// Columns solved together, whose vectors are read once with the matrix.
constexpr std::size_t kWidth = 4;
using Row = std::array<double, kWidth>;

constexpr double kTolerance = 1e-6;
/// Far above the bound for any ridge that is of use: at 1e-3 it is 230.
constexpr int kMostSteps = 1000;
/// Rows handled together.
constexpr std::size_t kBlock = 4096;

/// A symmetric sparse matrix by rows.
class Matrix {
 public:
  Matrix(std::size_t size, const std::vector<Triangle>& faces, const std::vector<std::array<double, 6>>& sums)
      : starts_(size + 1, 0), diagonal_(size, 0) {
    const auto forOffDiagonals = [&](const auto& visit) {
      for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = faces[f][k], b = faces[f][(k + 1) % 3];
          if (sums[f][3 + k] != 0 && a != b) visit(a, b, sums[f][3 + k]);
        }
      }
    };
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        diagonal_[faces[f][k]] += sums[f][k];
        // A face with a point at two corners interpolates with the sum of their weights.
        if (faces[f][k] == faces[f][(k + 1) % 3]) diagonal_[faces[f][k]] += 2 * sums[f][3 + k];
      }
    }
    forOffDiagonals([&](std::uint32_t a, std::uint32_t b, double) { ++starts_[a + 1], ++starts_[b + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    entries_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    forOffDiagonals([&](std::uint32_t a, std::uint32_t b, double value) {
      entries_[next[a]++] = {b, value};
      entries_[next[b]++] = {a, value};
    });
  }

  /// Adds ridge times the sum of each row to the diagonal; rows without an entry get the diagonal 1.
  void addRidge(double ridge) {
    for (std::size_t i = 0; i < diagonal_.size(); ++i) {
      double sum = diagonal_[i];
      for (std::size_t e = starts_[i]; e < starts_[i + 1]; ++e) sum += entries_[e].value;
      diagonal_[i] = sum > 0 ? diagonal_[i] + ridge * sum : 1;
    }
  }

  double diagonal(std::size_t row) const { return diagonal_[row]; }
  Row times(std::size_t row, const std::vector<Row>& x) const {
    Row sum;
    for (std::size_t c = 0; c < kWidth; ++c) sum[c] = diagonal_[row] * x[row][c];
    for (std::size_t e = starts_[row]; e < starts_[row + 1]; ++e) {
      const Row& other = x[entries_[e].column];
      for (std::size_t c = 0; c < kWidth; ++c) sum[c] += entries_[e].value * other[c];
    }
    return sum;
  }

 private:
  struct Entry {
    std::uint32_t column;
    double value;
  };
  std::vector<std::size_t> starts_;
  std::vector<Entry> entries_;
  std::vector<double> diagonal_;
};

/// Solves kWidth columns at once.
class Solver {
 public:
  Solver(const Matrix& matrix, std::size_t size, const Parallel& parallel, Progress& progress)
      : matrix_(matrix), parallel_(parallel), progress_(progress), x_(size), p_(size), q_(size) {}

  /// The solution for the right sides `r`, which it leaves as the residual.
  const std::vector<Row>& solve(std::vector<Row>& r) {
    std::fill(x_.begin(), x_.end(), Row{});
    const auto precondition = [&](std::size_t i, std::size_t c) { return r[i][c] / matrix_.diagonal(i); };
    Row rz = sums([&](std::size_t i, std::size_t c) { return r[i][c] * precondition(i, c); });
    const Row first = rz;
    forRows([&](std::size_t i) {
      for (std::size_t c = 0; c < kWidth; ++c) p_[i][c] = precondition(i, c);
    });
    for (int step = 0; step < kMostSteps && !isSolved(rz, first); ++step) {
      forRows([&](std::size_t i) { q_[i] = matrix_.times(i, p_); });
      const Row pq = sums([&](std::size_t i, std::size_t c) { return p_[i][c] * q_[i][c]; });
      const Row length = quotients(rz, pq);
      forRows([&](std::size_t i) {
        for (std::size_t c = 0; c < kWidth; ++c) {
          x_[i][c] += length[c] * p_[i][c];
          r[i][c] -= length[c] * q_[i][c];
        }
      });
      const Row next = sums([&](std::size_t i, std::size_t c) { return r[i][c] * precondition(i, c); });
      const Row share = quotients(next, rz);
      forRows([&](std::size_t i) {
        for (std::size_t c = 0; c < kWidth; ++c) p_[i][c] = precondition(i, c) + share[c] * p_[i][c];
      });
      rz = next;
    }
    return x_;
  }

 private:
  static bool isSolved(const Row& rz, const Row& first) {
    for (std::size_t c = 0; c < kWidth; ++c) {
      if (rz[c] > kTolerance * kTolerance * first[c]) return false;
    }
    return true;
  }
  /// A column that is solved has nothing left to divide.
  static Row quotients(const Row& a, const Row& b) {
    Row q;
    for (std::size_t c = 0; c < kWidth; ++c) q[c] = b[c] > 0 ? a[c] / b[c] : 0;
    return q;
  }
  template <class Body>
  void forRows(const Body& body) {
    parallel_.forBlocks(x_.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) body(i);
      progress_.advance(0);
    });
  }
  /// The sums over all rows, in blocks that do not depend on threads.
  template <class Term>
  Row sums(const Term& term) {
    std::vector<Row> blocks((x_.size() + kBlock - 1) / kBlock);
    parallel_.forBlocks(x_.size(), kBlock, [&](std::size_t begin, std::size_t end, int) {
      Row& sum = blocks[begin / kBlock];
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t c = 0; c < kWidth; ++c) sum[c] += term(i, c);
      }
    });
    Row total{};
    for (const Row& block : blocks) {
      for (std::size_t c = 0; c < kWidth; ++c) total[c] += block[c];
    }
    return total;
  }

  const Matrix& matrix_;
  const Parallel& parallel_;
  Progress& progress_;
  std::vector<Row> x_, p_, q_;
};

}  // namespace

SurfaceFitSystem::SurfaceFitSystem(std::size_t unknowns, const std::vector<Triangle>& faces, std::size_t columns)
    : faces_(faces), unknowns_(unknowns), columns_(columns), faceSums_(faces.size()), right_(unknowns * columns) {}

void SurfaceFitSystem::add(std::size_t face, const std::array<double, 3>& corners, double weight,
                           std::span<const double> residual) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = weight * corners[k];
    faceSums_[face][k] += w * corners[k];
    faceSums_[face][3 + k] += w * corners[(k + 1) % 3];
    double* right = &right_[faces_[face][k] * columns_];
    for (std::size_t c = 0; c < columns_; ++c) right[c] += w * residual[c];
  }
}

std::vector<float> SurfaceFitSystem::solve(double ridge, const Parallel& parallel, Progress& progress) const {
  progress.begin("fitting", static_cast<double>(columns_), "columns");
  Matrix matrix(unknowns_, faces_, faceSums_);
  matrix.addRidge(ridge);
  Solver solver(matrix, unknowns_, parallel, progress);
  std::vector<float> corrections(unknowns_ * columns_);
  std::vector<Row> right(unknowns_);
  for (std::size_t first = 0; first < columns_; first += kWidth) {
    const std::size_t width = std::min(kWidth, columns_ - first);
    for (std::size_t i = 0; i < unknowns_; ++i) {
      right[i] = {};
      std::copy_n(&right_[i * columns_ + first], width, right[i].begin());
    }
    const std::vector<Row>& solution = solver.solve(right);
    for (std::size_t i = 0; i < unknowns_; ++i) {
      for (std::size_t c = 0; c < width; ++c)
        corrections[i * columns_ + first + c] = static_cast<float>(solution[i][c]);
    }
    progress.advance(static_cast<double>(width));
  }
  progress.end();
  return corrections;
}

}  // namespace shbake
