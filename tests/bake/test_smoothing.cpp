// Smoothing: the mean of what noise explains, weights by hand where it does not, less noise on a curved mesh.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/smoothing.h"
#include "bake/support.h"
#include "sh/irradiance.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

std::vector<float> smooth(const LightingPoints& points, const TransferSet& baked,
                          const std::vector<std::uint8_t>& wanted = {}, int threads = 1) {
  const Parallel parallel(threads);
  Progress progress;
  return smoothedCoefficients(points, wanted, baked, parallel, progress);
}

/// Transfer of order 1 of points of albedo `rho` that lack these amounts, with these stated variances of the lack.
TransferSet lacking(double rho, const std::vector<double>& lacks, const std::vector<double>& variances) {
  TransferSet set;
  set.order = 1;
  const double open = sh::unshadowedNorm(1);
  for (std::size_t p = 0; p < lacks.size(); ++p) {
    set.coefficients.push_back(float(rho * (open - lacks[p])));
    set.error.push_back(float(std::sqrt(variances[p]) / open));
  }
  return set;
}

double lackOf(const std::vector<float>& coefficients, std::size_t p, double rho) {
  return sh::unshadowedNorm(1) - double(coefficients[p]) / rho;
}

constexpr double kRounding = 1e-6;

}  // namespace

TEST_CASE("differences that noise explains are averaged by their variances", "[smoothing]") {
  // Both triangles of a square: points 1 and 2, or 0 and 3, are not neighbours, which are they is read from the faces.
  const LightingPoints points = pointsOf(shapes::grid({}, {1, 0, 0}, {0, 1, 0}), {0.5f, 0.5f, 0.5f});
  const std::vector<double> lacks{0.1, 0.11, 0.12, 0.09}, variances{0.01, 0.02, 0.04, 0.01};
  const std::vector<float> smoothed = smooth(points, lacking(0.5, lacks, variances));
  for (std::uint32_t p = 0; p < 4; ++p) {
    double sum = 0, weight = 0;
    for (std::uint32_t q = 0; q < 4; ++q) {
      bool meets = false;
      for (const Triangle& t : points.facePoints) {
        const auto has = [&](std::uint32_t i) { return t[0] == i || t[1] == i || t[2] == i; };
        meets |= has(p) && has(q);
      }
      if (!meets) continue;
      sum += lacks[q] / variances[q];
      weight += 1 / variances[q];
    }
    CHECK(lackOf(smoothed, p, 0.5) == Approx(sum / weight).margin(kRounding));
  }
}

TEST_CASE("a step that noise does not explain weighs as much as its bias says", "[smoothing]") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const LightingPoints points = pointsOf(mesh);
  const double v = 1e-4, step = 0.5;
  std::vector<double> lacks(3, 0.2);
  const std::uint32_t odd = pointOfVertex(points, 2);
  lacks[odd] += step;
  const std::vector<float> smoothed = smooth(points, lacking(1, lacks, std::vector<double>(3, v)));
  // Seen from the two that agree: one bias is step^2 - 2v and the other none, their mean half of step^2 - 4v.
  // Biases count twice.
  const double far = 1 / (v + 2 * (step * step - 2 * v)), near = 1 / (v + step * step - 4 * v), own = 1 / v;
  for (const std::uint32_t p : {pointOfVertex(points, 0), pointOfVertex(points, 1)}) {
    CHECK(lackOf(smoothed, p, 1) == Approx(0.2 + step * far / (far + near + own)).margin(kRounding));
  }
  CHECK(lackOf(smoothed, odd, 1) == Approx(0.2 + step * own / (2 * far + own)).margin(kRounding));
}

TEST_CASE("points without noise, unwanted and black ones stay and are not looked at", "[smoothing]") {
  const LightingPoints points = pointsOf(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 2, 2));
  std::vector<double> lacks(9, 0.1), variances(9, 0.01);
  const std::uint32_t exact = pointOfVertex(points, 0), other = pointOfVertex(points, 4);
  lacks[exact] = 0.15;
  variances[exact] = 0;
  TransferSet baked = lacking(1, lacks, variances);
  baked.coefficients[other] = std::numeric_limits<float>::quiet_NaN();
  const auto check = [&](const std::vector<float>& smoothed) {
    CHECK(smoothed[exact] == baked.coefficients[exact]);
    CHECK(std::isnan(smoothed[other]));
    for (std::size_t p = 0; p < 9; ++p) {
      if (p == exact || p == other) continue;
      CHECK(std::isfinite(smoothed[p]));
    }
  };
  std::vector<std::uint8_t> wanted(9, 1);
  wanted[other] = 0;
  check(smooth(points, baked, wanted));
  LightingPoints black = points;
  black.pointAlbedo[other] = {};
  check(smooth(black, baked));
}

TEST_CASE("few rays gain, many lose nothing, and threads change nothing", "[smoothing]") {
  const LightingPoints points = pointsOf(shapes::icosphere(4, 0.1), {0.5f, 0.6f, 0.7f});
  const TransferSet truth = bakeAll(points, optionsOf(TransferKind::shadowed, 3, 4096, 7)).transfer;
  const auto error = [&](const std::vector<float>& values) { return relativeDifference(values, truth.coefficients); };
  // On a fine mesh: 1.6 to 2.1 times better at 16 rays, 1.25 to 1.6 at 64, and never worse by more than 1 %.
  for (const auto& [rays, most] : {std::pair{16, 1 / 1.6}, {64, 1 / 1.25}, {256, 1.01}}) {
    INFO(rays << " rays");
    const TransferSet baked = bakeAll(points, optionsOf(TransferKind::shadowed, 3, rays)).transfer;
    const std::vector<float> smoothed = smooth(points, baked);
    CHECK(error(smoothed) < most * error(baked.coefficients));
    CHECK(sameBits(smoothed, smooth(points, baked, {}, 2)));
  }
}
