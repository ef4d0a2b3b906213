// Fitting to the surface: the best values of a closed form, what is left alone, and never worse than point sampling.
#include <Eigen/Dense>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "bake/floor_and_wall.h"
#include "bake/support.h"
#include "bake/surface_error.h"
#include "bake/surface_fit.h"
#include "base/error.h"
#include "mesh/mesh_reader.h"
#include "sh/irradiance.h"
#include "support/face_parts.h"
#include "support/stopping.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

struct Fitted {
  TransferSet before, after;
  FitReport report;
};

Fitted bakeAndFit(const LightingPoints& points, const BakeOptions& bake, const SurfaceFitOptions& fit,
                  const std::vector<std::uint8_t>& wanted = {}, int threads = 1) {
  const Parallel parallel(threads);
  Progress progress;
  PointBake baked = bakePoints(points, wanted, bake, parallel, progress);
  Fitted result{baked.transfer, {}, {}};
  result.report = fitToSurface(points, wanted, baked, bake, fit, parallel, progress);
  result.after = std::move(baked.transfer);
  return result;
}

SurfaceFitOptions kindOf(FitKind kind) {
  SurfaceFitOptions options;
  options.kind = kind;
  return options;
}

/// The mean square over floorAndWall() by which interpolated shares of the sky err.
template <class OfPoint>
double meanSquare(const LightingPoints& points, const OfPoint& ofPoint) {
  double sum = 0, count = 0;
  overFaces(points, 40, [&](std::size_t f, const std::array<double, 3>& w) {
    double seen = 0;
    for (std::size_t k = 0; k < 3; ++k) seen += w[k] * ofPoint(points.facePoints[f][k]);
    sum += std::pow(seen - skyOfFloorAndWall(points, f, w), 2);
    ++count;
  });
  return sum / count;
}

/// The values of the points of floorAndWall() that interpolate it with the least mean square.
Eigen::VectorXd bestValues(const LightingPoints& points) {
  const auto n = Eigen::Index(points.size());
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  overFaces(points, 40, [&](std::size_t f, const std::array<double, 3>& w) {
    const double sky = skyOfFloorAndWall(points, f, w);
    for (std::size_t a = 0; a < 3; ++a) {
      right[points.facePoints[f][a]] += w[a] * sky;
      for (std::size_t b = 0; b < 3; ++b) g(points.facePoints[f][a], points.facePoints[f][b]) += w[a] * w[b];
    }
  });
  return g.ldlt().solve(right);
}

SurfaceError measure(const LightingPoints& points, const TransferSet& transfer, BakeOptions bake) {
  bake.seed = 4711;
  // Sets of 512 rays: what they miss of the truth is the same before and after.
  bake.rays = 128;
  const Parallel parallel(1);
  Progress progress;
  return measureSurfaceError(points, transfer, bake, {1024, 0}, parallel, progress);
}

/// A mesh of the folder of real ones; nothing and a warning where there is none.
std::optional<Mesh> sharedMesh(const std::string& name) {
  const std::string path = std::string(SHBAKE_SHARED_DIR) + "/meshes/" + name;
  if (!std::filesystem::exists(path)) {
    WARN("skipped: " << path << " is absent");
    return {};
  }
  Progress progress;
  return readMesh(path, progress);
}

}  // namespace

TEST_CASE("the fit finds the best values of a floor and a wall", "[surface_fit]") {
  const LightingPoints points = pointsOf(floorAndWall(3));
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 1, 2048);
  SurfaceFitOptions options = kindOf(FitKind::surface);
  options.samplesPerPoint = 64;
  options.raysPerSample = 1024;
  const Fitted fitted = bakeAndFit(points, bake, options);
  const double open = sh::unshadowedNorm(1);
  const auto errorOf = [&](const TransferSet& set) {
    return meanSquare(points, [&](std::uint32_t p) { return double(set.at(p, 0)[0]) / open; });
  };
  const Eigen::VectorXd values = bestValues(points);
  const double point = errorOf(fitted.before), fit = errorOf(fitted.after);
  const double best = meanSquare(points, [&](std::uint32_t p) { return values[p]; });
  REQUIRE(best < 0.7 * point);
  // K samples for each unknown add 1/K of the residual's square to the error (and scatter about it), while the ridge of
  // (0.4 + little) / 64 leaves less than (mu / (1/4 + mu))^2 of what there is to remove, 1/4 being the least eigenvalue
  // of a triangle's mass matrix relative to its row sums.
  const double mu = fitted.report.ridge;
  CHECK(mu < 0.5 / 64);
  CHECK(fit < best * (1 + 4.0 / 64) + std::pow(mu / (0.25 + mu), 2) * (point - best));
  CHECK(fitted.report.samples == 64 * points.size());
  CHECK(fitted.report.fittedPoints == points.size());
  // The held-out samples find the same errors.
  CHECK((fitted.report.before.low < std::sqrt(point) && std::sqrt(point) < fitted.report.before.high));
  CHECK((fitted.report.after.low < std::sqrt(fit) && std::sqrt(fit) < fitted.report.after.high));
}

TEST_CASE("what interpolates exactly is left alone, at the cost of a glance", "[surface_fit]") {
  LightingPointOptions flat;
  flat.normals = NormalSource::flat;
  for (const Mesh& solid : shapes::convexSolids()) {
    INFO(solid.source);
    const LightingPoints points = pointsOf(solid, {0.5f, 0.5f, 0.5f}, flat);
    const Fitted fitted = bakeAndFit(points, optionsOf(TransferKind::shadowed, 3, 64), kindOf(FitKind::automatic));
    CHECK(sameBits(fitted.before.coefficients, fitted.after.coefficients));
    CHECK(fitted.report.reason == "interpolation between the vertices is exact");
    CHECK(fitted.report.samples == 0);
    // Two sets of half the bake's rays, from 24 places or for a fiftieth of its rays.
    const double places = std::max(24.0, 2 * std::ceil(0.02 * double(points.size()) / 2));
    CHECK(fitted.report.rays == 2 * 32 * places);
    CHECK(fitted.report.after.rms < 1e-6);
  }
}

TEST_CASE("a fit that is not asked for or has nothing to do traces nothing", "[surface_fit]") {
  const LightingPoints points = pointsOf(floorAndWall(2)), black = pointsOf(floorAndWall(2), {0, 0, 0});
  const auto check = [&](const LightingPoints& on, TransferKind kind, FitKind fit, const char* reason) {
    const Fitted fitted = bakeAndFit(on, optionsOf(kind, 2, 64), kindOf(fit));
    CHECK(sameBits(fitted.before.coefficients, fitted.after.coefficients));
    CHECK(fitted.report.rays == 0);
    CHECK(fitted.report.heldOut == 0);
    CHECK(fitted.report.reason == reason);
  };
  check(points, TransferKind::shadowed, FitKind::vertex, "not asked for");
  check(points, TransferKind::unshadowed, FitKind::surface, "unshadowed transfer has a closed form, which is kept");
  check(black, TransferKind::shadowed, FitKind::automatic, "no face has an area and reflects light");
}

TEST_CASE("where rays are few their noise is smoothed, not fitted", "[surface_fit]") {
  const LightingPoints points = pointsOf(shapes::openCavity(3, 0.08, 25));
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 3, 16);
  const Fitted fitted = bakeAndFit(points, bake, kindOf(FitKind::automatic));
  CHECK(fitted.report.reason == "interpolation between the vertices errs less than the noise of the rays");
  CHECK(fitted.report.samples == 0);
  CHECK(fitted.report.smoothedPoints > points.size() / 2);
  CHECK(measure(points, fitted.after, bake).rms < measure(points, fitted.before, bake).rms);
}

TEST_CASE("to find a fit of no use takes a twentieth of the rays", "[surface_fit]") {
  // Noise is all that matters in a smooth cavity at these rays. Its points are enough for two glances.
  const LightingPoints points = pointsOf(shapes::openCavity(4, 0.08, 25));
  for (const int rays : {32, 64, 256}) {
    const Fitted fitted = bakeAndFit(points, optionsOf(TransferKind::shadowed, 3, rays), kindOf(FitKind::automatic));
    INFO(rays << " rays, " << points.size() << " points: " << fitted.report.reason);
    CHECK(fitted.report.samples == 0);
    // Places come in pairs, with two sets of half the bake's rays each.
    CHECK(fitted.report.rays <= 0.05 * rays * double(points.size()) + 2 * 2 * 2 * rays / 2);
    CHECK(fitted.report.smoothedPoints > 0);
  }
}

TEST_CASE("what is good enough as it is stays as it is", "[surface_fit]") {
  const LightingPoints points = pointsOf(floorAndWall(3));
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 2, 256);
  SurfaceFitOptions options = kindOf(FitKind::automatic);
  const RmsError before = bakeAndFit(points, bake, options).report.before;
  REQUIRE(before.low > 0);
  options.enough = 2 * before.high;
  const Fitted left = bakeAndFit(points, bake, options);
  CHECK(left.after.coefficients == left.before.coefficients);
  CHECK(left.report.reason == "the surface error is within the tolerance as it is");
  CHECK(left.report.fittedRays == 0);
  CHECK(left.report.after.rms == left.report.before.rms);
  CHECK(left.report.after.high <= options.enough);
  options.enough = before.low / 2;
  const Fitted fitted = bakeAndFit(points, bake, options);
  CHECK(fitted.report.fittedPoints > 0);
  CHECK(fitted.report.fittedRays >= 32 * static_cast<double>(fitted.report.samples));
  // Whoever asks for a fit gets it.
  options.kind = FitKind::surface;
  options.enough = 1;
  CHECK(bakeAndFit(points, bake, options).report.fittedPoints > 0);
}

TEST_CASE("the choice is never worse than point sampling", "[surface_fit]") {
  std::vector<std::pair<std::string, Mesh>> meshes{{"cavity", shapes::openCavity(2, 0.08, 25)},
                                                   {"chess piece", shapes::chessPiece(1)},
                                                   {"city", shapes::city(3, 2, 2)},
                                                   {"cornell room", shapes::cornellRoom(4)},
                                                   {"floor and wall", floorAndWall(2)},
                                                   {"blob", shapes::icosphere(2, 0.25)}};
  const std::size_t made = meshes.size();
  for (const char* name : {"igl_decimated-knight.off", "cow.obj", "suzanne.obj"}) {
    if (auto mesh = sharedMesh(name)) meshes.emplace_back(name, std::move(*mesh));
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const LightingPoints points = pointsOf(meshes[i].second, {0.5f, 0.5f, 0.5f});
    for (const int rays : {16, 256}) {
      INFO(meshes[i].first << ", " << rays << " rays");
      const BakeOptions bake = optionsOf(TransferKind::shadowed, 3, rays);
      const Fitted fitted = bakeAndFit(points, bake, kindOf(FitKind::automatic));
      INFO(fitted.report.reason);
      // Coarse scans gain a tenth or more.
      const double most = i < made ? 1.05 : 0.9;
      CHECK(measure(points, fitted.after, bake).rms < most * measure(points, fitted.before, bake).rms);
      CHECK(fitted.report.after.rms <= fitted.report.before.rms);
      CHECK(sameBits(fitted.before.error, fitted.after.error));
      CHECK(sameBits(fitted.before.visibility, fitted.after.visibility));
    }
  }
}

TEST_CASE("reflections are fitted as they reach the surface", "[surface_fit]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(3), {0.8f, 0.8f, 0.8f});
  for (const int bounces : {2, BakeOptions::kBouncesAuto}) {
    INFO(bounces << " bounces");
    BakeOptions bake = optionsOf(TransferKind::interreflected, 2, 256);
    bake.bounces = bounces;
    const Fitted fitted = bakeAndFit(points, bake, kindOf(FitKind::automatic));
    CHECK(fitted.report.fittedPoints > 0);
    CHECK(measure(points, fitted.after, bake).rms < measure(points, fitted.before, bake).rms);
  }
}

TEST_CASE("each channel of a colour is fitted alike", "[surface_fit]") {
  const Mesh mesh = floorAndWall(3);
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 2, 128);
  const TransferSet colored = bakeAndFit(pointsOf(mesh, {0.25f, 0.5f, 1}), bake, kindOf(FitKind::surface)).after;
  const TransferSet grey = bakeAndFit(pointsOf(mesh), bake, kindOf(FitKind::surface)).after;
  REQUIRE(colored.channels == 3);
  for (std::uint32_t p = 0; p < grey.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      const double albedo = std::pow(2, c - 2);
      for (std::size_t i = 0; i < 4; ++i) {
        CHECK(double(colored.at(p, c)[i]) == Approx(albedo * double(grey.at(p, 0)[i])).margin(1e-5));
      }
    }
  }
}

TEST_CASE("blockers, black faces and points of no face keep what they have", "[surface_fit]") {
  const Mesh floor = shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 3, 3), wall = shapes::grid({}, {0, 1, 0}, {0, 0, 1}, 3, 3);
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 2, 256);
  const auto check = [&](const LightingPoints& points, const std::vector<std::uint8_t>& wanted) {
    const Fitted fitted = bakeAndFit(points, bake, kindOf(FitKind::surface), wanted);
    std::size_t moved = 0;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      const auto before = fitted.before.at(p, 0), after = fitted.after.at(p, 0);
      const bool same = std::equal(before.begin(), before.end(), after.begin());
      if (points.pointNormal[p].x > 0.5f) CHECK(same);
      moved += same ? 0 : 1;
    }
    CHECK(moved == fitted.report.fittedPoints);
    CHECK(moved == 16);
  };
  SECTION("blockers") {
    const LightingPoints points = pointsOf(shapes::merged(floor, wall));
    std::vector<std::uint8_t> wanted;
    for (const Vec3f& n : points.pointNormal) wanted.push_back(n.z > 0.5f ? 1 : 0);
    check(points, wanted);
  }
  SECTION("black faces") {
    Mesh mesh = shapes::merged(shapes::colored(floor, {0.5f, 0.5f, 0.5f}), shapes::colored(wall, {0, 0, 0}));
    mesh.faceColorEncoding = ColorEncoding::linear;
    check(pointsOf(mesh), {});
  }
}

TEST_CASE("a fit depends on seed and options, not on threads or memory", "[surface_fit]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(1), {0.5f, 0.6f, 0.7f});
  BakeOptions bake = optionsOf(TransferKind::interreflected, 2, 64);
  const auto fit = [&](int threads) {
    return bakeAndFit(points, bake, kindOf(FitKind::automatic), {}, threads).after.coefficients;
  };
  const std::vector<float> one = fit(1);
  CHECK(sameBits(one, fit(3)));
  bake.memory = 1;
  CHECK(sameBits(one, fit(1)));
  bake.seed = 2;
  CHECK_FALSE(sameBits(one, fit(1)));
}

TEST_CASE("a fit out of range is refused", "[surface_fit]") {
  const LightingPoints points = pointsOf(floorAndWall(1));
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 2, 16);
  const auto fails = [&](SurfaceFitOptions fit, const char* words) {
    CHECK_THROWS_WITH(bakeAndFit(points, bake, fit), Catch::Contains(words));
  };
  SurfaceFitOptions fit = kindOf(FitKind::surface);
  fit.samplesPerPoint = 0;
  fails(fit, "samples per point 0 is out of range");
  fit.samplesPerPoint = 65;
  fails(fit, "use 1 to 64");
  fit.samplesPerPoint = 1;
  fit.raysPerSample = 15;
  fails(fit, "rays per sample 15 is out of range");
  fit.raysPerSample = 65537;
  fails(fit, "use 16 to 65536");
  PointBake other = bakeAll(pointsOf(floorAndWall(2)), bake);
  const Parallel parallel(1);
  Progress progress;
  CHECK_THROWS_WITH(fitToSurface(points, {}, other, bake, kindOf(FitKind::surface), parallel, progress),
                    Catch::Contains("does not belong to these points"));
}

TEST_CASE("a fit counts, stops, and leaves the bake as it was then", "[surface_fit]") {
  const LightingPoints points = pointsOf(floorAndWall(3));
  const BakeOptions bake = optionsOf(TransferKind::shadowed, 2, 64);
  const PointBake baked = bakeAll(points, bake);
  const double faces = double(points.faces.size());
  // One tree serves the places that judge and those that are fitted to.
  const std::vector<StageLimit> limits{{"placing samples", faces},
                                       {"twin faces", faces},
                                       {"building", 1},
                                       {"searching contacts", 4096},
                                       {"tracing samples", 16 * 2 * 32},
                                       {"placing samples", faces},
                                       {"searching contacts", 4096},
                                       {"tracing samples", 16 * 32},
                                       {"fitting", 4}};
  checkStopping(
      [&](Progress& progress) {
        const Parallel parallel(1);
        PointBake changed = baked;
        try {
          fitToSurface(points, {}, changed, bake, kindOf(FitKind::surface), parallel, progress);
        } catch (const Error&) {
          CHECK(sameBits(changed.transfer.coefficients, baked.transfer.coefficients));
          throw;
        }
        CHECK_FALSE(sameBits(changed.transfer.coefficients, baked.transfer.coefficients));
      },
      limits);
}
