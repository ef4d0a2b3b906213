// The system of a fit: a dense twin, the closed form of constants, points without samples.
#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/support.h"
#include "bake/surface_fit_system.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// The tolerance of the solver in the norm of the diagonal, and rounding to float.
constexpr double kSolved = 1e-5;

std::vector<float> solve(const SurfaceFitSystem& system, double ridge, int threads = 1) {
  const Parallel parallel(threads);
  Progress progress;
  return system.solve(ridge, parallel, progress);
}

std::array<double, 3> randomWeights(std::uint64_t i) {
  const double root = std::sqrt(hashUnit(3, 2 * i)), y = hashUnit(3, 2 * i + 1);
  return {1 - root, root * (1 - y), root * y};
}

}  // namespace

TEST_CASE("the fit solves its equations", "[surface_fit]") {
  // Faces that meet in all ways, one that has a point at two corners, and a point that no face has.
  const std::vector<Triangle> faces{{0, 1, 2}, {2, 1, 3}, {3, 1, 4}, {5, 5, 0}, {4, 3, 2}};
  constexpr std::size_t kUnknowns = 7, kColumns = 6, kSamples = 60;
  SurfaceFitSystem system(kUnknowns, faces, kColumns);
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns), right = Eigen::MatrixXd::Zero(kUnknowns, kColumns);
  for (std::size_t s = 0; s < kSamples; ++s) {
    const std::size_t face = s % faces.size();
    const std::array<double, 3> w = randomWeights(s);
    const double weight = 0.5 + hashUnit(4, s);
    std::vector<double> residual(kColumns);
    for (std::size_t c = 0; c < kColumns; ++c) residual[c] = hashUnit(5, s * kColumns + c) - 0.5;
    system.add(face, w, weight, residual);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(kUnknowns);
    for (std::size_t k = 0; k < 3; ++k) b[faces[face][k]] += w[k];
    g += weight * b * b.transpose();
    for (std::size_t c = 0; c < kColumns; ++c) right.col(Eigen::Index(c)) += weight * residual[c] * b;
  }
  for (const double ridge : {0.01, 0.3, 10.0}) {
    INFO("ridge " << ridge);
    const std::vector<float> x = solve(system, ridge);
    Eigen::MatrixXd whole = g;
    whole.diagonal() += ridge * g.rowwise().sum();
    whole(6, 6) = 1;
    const Eigen::MatrixXd expected = whole.ldlt().solve(right);
    for (std::size_t p = 0; p < kUnknowns; ++p) {
      for (std::size_t c = 0; c < kColumns; ++c) {
        const double value = expected(Eigen::Index(p), Eigen::Index(c));
        CHECK(double(x[p * kColumns + c]) == Approx(value).margin(kSolved * expected.norm()));
      }
    }
    for (std::size_t c = 0; c < kColumns; ++c) CHECK(x[6 * kColumns + c] == 0);
    CHECK(sameBits(x, solve(system, ridge, 2)));
  }
}

TEST_CASE("a linear residual is fitted exactly but for the ridge, a constant one as derived", "[surface_fit]") {
  // M is the row sums of G, so that a constant c solves (G + mu M) x = G c with x = c / (1 + mu), wherever samples are.
  const LightingPoints points = pointsOf(shapes::grid({}, {1, 0, 0}, {0, 2, 0}, 7, 5));
  SurfaceFitSystem system(points.size(), points.facePoints, 2);
  for (std::size_t s = 0; s < 8 * points.faces.size(); ++s) {
    const std::size_t f = s % points.faces.size();
    const std::array<double, 3> w = randomWeights(s);
    Vec3d at;
    for (std::size_t k = 0; k < 3; ++k) at += Vec3d(points.positions[points.faces[f][k]]) * w[k];
    system.add(f, w, 1, std::array{3.0, at.x - 2 * at.y});
  }
  const std::vector<float> loose = solve(system, 0.25), tight = solve(system, 1e-6);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3d at(points.positions[points.pointPosition[p]]);
    CHECK(double(loose[2 * p]) == Approx(3 / 1.25).epsilon(kSolved));
    // Eight samples a face leave no direction of G below a hundredth of M: the ridge of 1e-6 moves a value by 1e-4.
    CHECK(double(tight[2 * p + 1]) == Approx(at.x - 2 * at.y).margin(1e-4 * 3));
  }
}
