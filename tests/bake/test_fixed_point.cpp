// Fixed points: against dense solves, column by column, and where there is none.
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "bake/fixed_point.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

using Matrix = Eigen::MatrixXd;

/// x = albedo_k K x + b_k for each column k: reflections between points, K with rows that sum to at most 1.
struct Problem {
  Matrix kernel;
  std::vector<double> albedo;
  Matrix b;
};

Problem randomProblem(int rows, const std::vector<double>& albedo, std::uint64_t seed) {
  Problem p{Matrix(rows, rows), albedo, Matrix(rows, int(albedo.size()))};
  std::uint64_t drawn = 0;
  for (int i = 0; i < rows; ++i) {
    // Uneven rows: an eighth power leaves each point few partners, so that the spectrum spreads.
    for (int j = 0; j < rows; ++j) p.kernel(i, j) = std::pow(hashUnit(seed, drawn++), 8);
    p.kernel.row(i) *= (0.9 + 0.1 * hashUnit(seed, drawn++)) / p.kernel.row(i).sum();
    for (std::size_t k = 0; k < albedo.size(); ++k) p.b(i, int(k)) = hashUnit(seed, drawn++);
  }
  return p;
}

/// Column k of the exact solution.
Eigen::VectorXd exactColumn(const Problem& p, int k) {
  const auto n = p.kernel.rows();
  return (Matrix::Identity(n, n) - p.albedo[std::size_t(k)] * p.kernel).partialPivLu().solve(p.b.col(k));
}

struct Solved {
  FixedPointResult result;
  std::vector<float> x;
};

/// Solves the columns listed. Each value of the map is formed from its own column alone, in one order.
Solved solve(const Problem& p, const std::vector<int>& columns, const FixedPointOptions& options, int threads = 1) {
  const auto rows = std::size_t(p.kernel.rows()), n = columns.size();
  const Parallel parallel(threads);
  Solved s;
  s.x.resize(rows * n);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < n; ++c) s.x[r * n + c] = float(p.b(int(r), columns[c]));
  }
  const auto map = [&](const float* in, float* out) {
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t c = 0; c < n; ++c) {
        double sum = 0;
        for (std::size_t j = 0; j < rows; ++j) sum += p.kernel(int(r), int(j)) * double(in[j * n + c]);
        out[r * n + c] = float(p.b(int(r), columns[c]) + p.albedo[std::size_t(columns[c])] * sum);
      }
    }
  };
  Progress progress;
  s.result = solveFixedPoint(rows, n, s.x, map, options, parallel, progress);
  return s;
}

std::vector<float> column(const Solved& s, std::size_t n, std::size_t c) {
  std::vector<float> out;
  for (std::size_t i = c; i < s.x.size(); i += n) out.push_back(s.x[i]);
  return out;
}

double errorOf(const Solved& s, std::size_t n, std::size_t c, const Eigen::VectorXd& exact) {
  double sum = 0;
  for (int r = 0; r < exact.size(); ++r) sum += std::pow(double(s.x[std::size_t(r) * n + c]) - exact(r), 2);
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("contractions are solved to the tolerance of a dense solve", "[fixed_point]") {
  const std::vector<double> albedo{0, 0.2, 0.5, 0.8, 0.9, 0.99, 1, 0.5};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Problem p = randomProblem(60, albedo, seed);
    for (const double tolerance : {1e-1, 1e-3}) {
      const Solved s = solve(p, {0, 1, 2, 3, 4, 5, 6, 7}, {tolerance, 200});
      REQUIRE(s.result.converged);
      for (int k = 0; k < 8; ++k) {
        // The stated error is the residual times a lower bound of the inverse's norm that is at least 1: the inverse's
        // norm itself bounds the ratio of true to stated error in any case. The result is one map further.
        const auto n = p.kernel.rows();
        const Matrix inverse = (Matrix::Identity(n, n) - albedo[std::size_t(k)] * p.kernel).inverse();
        const double bound = inverse.jacobiSvd().singularValues()(0);
        const Eigen::VectorXd exact = exactColumn(p, k);
        const double rounding = 4 * kHalfUlp * exact.norm() * bound;
        const double error = errorOf(s, 8, std::size_t(k), exact);
        INFO("seed " << seed << ", albedo " << albedo[std::size_t(k)]);
        CHECK(error <= tolerance * bound + rounding);
        // That the ratio is sharp enough to keep the promise of the header on kernels like those of reflections.
        CHECK(error <= tolerance + rounding);
      }
    }
  }
}

TEST_CASE("a small first residual is no proof of being near", "[fixed_point]") {
  // White walls all around a hole that lets 1e-4 of the light in and out: all of them are as bright as the sky.
  const int rows = 64;
  const double hole = 1e-4;
  const Problem p{Matrix::Constant(rows, rows, (1 - hole) / rows), {1}, Matrix::Constant(rows, 1, hole)};
  const FixedPointOptions options{.tolerance = 0.1};
  const Solved s = solve(p, {0}, options);
  REQUIRE(s.result.converged);
  CHECK(errorOf(s, 1, 0, Eigen::VectorXd::Ones(rows)) <= options.tolerance);
}

TEST_CASE("a column's result does not depend on the columns beside it", "[fixed_point]") {
  const Problem p = randomProblem(80, {0.99, 0, 0.3, 0.9, 0.5, 1}, 7);
  const FixedPointOptions options{1e-3, 200};
  const Solved all = solve(p, {0, 1, 2, 3, 4, 5}, options);
  REQUIRE(all.result.converged);
  int most = 0;
  for (int k = 0; k < 6; ++k) {
    const Solved alone = solve(p, {k}, options);
    INFO("column " << k << " takes " << alone.result.steps << " steps alone, all take " << all.result.steps);
    CHECK(sameBits(column(all, 6, std::size_t(k)), alone.x));
    most = std::max(most, alone.result.steps);
  }
  CHECK(all.result.steps == most);
}

TEST_CASE("threads do not change a bit", "[fixed_point]") {
  const Problem p = randomProblem(100, {0.9, 0.99, 0.5, 0.2}, 3);
  const Solved one = solve(p, {0, 1, 2, 3}, {1e-4, 100}, 1);
  for (const int threads : {2, 3}) CHECK(sameBits(solve(p, {0, 1, 2, 3}, {1e-4, 100}, threads).x, one.x));
}

TEST_CASE("columns of zeros stay zero, and converge at once", "[fixed_point]") {
  Problem p = randomProblem(30, {0.9, 0.9, 0.9, 0.9}, 5);
  p.b.col(1).setZero();
  p.b.col(3).setZero();
  const Solved s = solve(p, {0, 1, 2, 3}, {1e-4, 100});
  CHECK(s.result.converged);
  for (const std::size_t k : {1, 3}) {
    for (const float value : column(s, 4, k)) CHECK(value == 0);
  }
  const Solved only = solve(p, {1, 3}, {1e-4, 100});
  CHECK(only.result.converged);
  CHECK(only.result.steps == 1);
}

TEST_CASE("maps without a fixed point are reported as not converged", "[fixed_point]") {
  const Parallel parallel(1);
  std::vector<float> x(40, 0.0f);
  const auto shift = [](const float* in, float* out) {
    for (int i = 0; i < 40; ++i) out[i] = in[i] + 1;
  };
  Progress progress;
  const FixedPointResult result = solveFixedPoint(10, 4, x, shift, {1e-3, 50}, parallel, progress);
  CHECK_FALSE(result.converged);
  CHECK(result.steps == 50);
}

TEST_CASE("an expansion of many dimensions is never reported as solved when it is not", "[fixed_point]") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    // 2 Q x + b with a random rotation Q of 50 dimensions: more directions than the window holds.
    const int n = 50;
    Matrix random(n, n);
    for (int i = 0; i < n * n; ++i) random(i) = 2 * hashUnit(seed, std::uint64_t(i)) - 1;
    const Matrix q = 2 * Matrix(random.householderQr().householderQ());
    const auto map = [&](const float* in, float* out) {
      for (int r = 0; r < n; ++r) {
        double sum = 1;
        for (int j = 0; j < n; ++j) sum += q(r, j) * double(in[j]);
        out[r] = float(sum);
      }
    };
    const Parallel parallel(1);
    std::vector<float> x(std::size_t(n), 0.0f);
    Progress progress;
    const FixedPointResult result = solveFixedPoint(std::size_t(n), 1, x, map, {1e-3, 60}, parallel, progress);
    CHECK_FALSE(result.converged);
    CHECK(result.steps == 60);
  }
}

TEST_CASE("a linear map that expands in few dimensions is still solved", "[fixed_point]") {
  // x = 1 - 3 x: plain iteration diverges, Anderson's finds 1/4.
  const Parallel parallel(1);
  std::vector<float> x(4, 0.0f);
  const auto map = [](const float* in, float* out) {
    for (int i = 0; i < 4; ++i) out[i] = 1 - 3 * in[i];
  };
  Progress progress;
  const FixedPointResult result = solveFixedPoint(4, 1, x, map, {1e-5, 20}, parallel, progress);
  CHECK(result.converged);
  for (const float value : x) CHECK(std::abs(value - 0.25f) < 1e-5f);
}
