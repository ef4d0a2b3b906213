// The surface error: closed forms between the vertices, intervals that keep their word, noise that is subtracted.
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/closed_forms.h"
#include "bake/floor_and_wall.h"
#include "bake/support.h"
#include "bake/surface_error.h"
#include "sh/irradiance.h"
#include "support/face_parts.h"
#include "support/stopping.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

/// Rounding of baked coefficients to float, of normals and of the tracer's sums.
constexpr double kRounding = 1e-6;

SurfaceError measure(const LightingPoints& points, const TransferSet& baked, const BakeOptions& bake,
                     std::size_t samples = 1024, std::size_t faces = 0, int threads = 1, const TruthRays& rays = {}) {
  const Parallel parallel(threads);
  Progress progress;
  return measureSurfaceError(points, baked, bake, {samples, faces, rays}, parallel, progress);
}

template <class T, class OfCorner>
T blended(const std::array<double, 3>& w, const OfCorner& ofCorner) {
  return ofCorner(0) * w[0] + ofCorner(1) * w[1] + ofCorner(2) * w[2];
}

/// The mean square over floorAndWall() of what interpolation of `baked`, of order 1 and albedo 1, errs by.
double meanSquareOfFloorAndWall(const LightingPoints& points, const TransferSet& baked) {
  const double open = sh::unshadowedNorm(1);
  double sum = 0, count = 0;
  overFaces(points, 40, [&](std::size_t f, const std::array<double, 3>& w) {
    const double seen =
        blended<double>(w, [&](std::size_t k) { return double(baked.at(points.facePoints[f][k], 0)[0]) / open; });
    sum += std::pow(seen - skyOfFloorAndWall(points, f, w), 2);
    ++count;
  });
  return sum / count;
}

/// The mean square that a result stands for, and the standard error that its interval states of it.
double square(const SurfaceError& e) {
  return e.rms * e.rms;
}
double errorOfSquare(const SurfaceError& e) {
  return (e.high * e.high - e.rms * e.rms) / 1.959963984540054;
}

/// The value that a chi-squared variable of n degrees of freedom stays below as a normal one stays below z (Wilson and
/// Hilferty, 1931).
double chiSquared(int n, double z) {
  const double s = 2 / (9.0 * n);
  return n * std::pow(1 - s + z * std::sqrt(s), 3);
}

/// A floor of side 1e-3 around the origin, and a wall that hides part of its sky: across so little, transfer is linear
/// to 1e-6.
Mesh smallFloorBesideWall() {
  const double e = 5e-4;
  return shapes::merged(shapes::grid({-e, -e, 0}, {2 * e, 0, 0}, {0, 2 * e, 0}),
                        shapes::grid({1, 1.5, 0.3}, {0, -2.5, 0}, {0, 0, 1.7}));
}

}  // namespace

TEST_CASE("convex solids with flat faces have no error between their vertices", "[surface_error]") {
  // Every sample lies on its face but for rounding, and must see the whole sky whatever is near: slivers, other faces.
  LightingPointOptions flat;
  flat.normals = NormalSource::flat;
  const shapes::Matrix3 turn = shapes::rotationAbout({1, 2, 3}, 0.7);
  for (const Mesh& solid : shapes::convexSolids()) {
    INFO(solid.source);
    const LightingPoints points =
        pointsOf(shapes::translated(shapes::rotated(solid, turn), {3, 4, 5}), {1, 1, 1}, flat);
    const BakeOptions options = optionsOf(TransferKind::shadowed, 3, 16);
    const SurfaceError e = measure(points, bakeAll(points, options).transfer, options, 256);
    CHECK(e.samples == 256);
    CHECK(e.rays == 1024);
    CHECK(e.worst < kRounding);
    CHECK(e.high < kRounding);
  }
}

TEST_CASE("between a floor and a wall the error is that of the closed form", "[surface_error]") {
  const LightingPoints points = pointsOf(floorAndWall(3));
  const BakeOptions options = optionsOf(TransferKind::shadowed, 1, 1024);
  const TransferSet baked = bakeAll(points, options).transfer;
  const double expected = meanSquareOfFloorAndWall(points, baked);
  REQUIRE(std::sqrt(expected) > 0.01);
  constexpr int kSeeds = 32;
  Samples squares;
  double scatter = 0, stated = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    BakeOptions other = optionsOf(TransferKind::shadowed, 1, 128, static_cast<std::uint64_t>(100 + seed));
    const SurfaceError e = measure(points, baked, other, 512);
    CHECK((e.low < e.rms && e.rms < e.high && e.high < e.worst));
    squares.add(std::vector<double>{square(e)});
    scatter += std::pow(square(e) - expected, 2);
    stated += std::pow(errorOfSquare(e), 2) / kSeeds;
  }
  CHECK(std::abs(squares.mean(0) - expected) < errorLimit(1, kSeeds) * squares.standardError(0));
  // The stated variance is that of the scatter about the truth: two tails of 1e-4.
  CHECK(scatter / stated < chiSquared(kSeeds, 3.72));
  CHECK(scatter / stated > chiSquared(kSeeds, -3.72));
}

TEST_CASE("the worst sample is told with its place", "[surface_error]") {
  // One vertex of the floor is wrong by all its light: the error falls linearly to nothing at its neighbours.
  const Mesh mesh = shapes::grid({10, 20, 0}, {4, 0, 0}, {0, 4, 0}, 4, 4);
  const LightingPoints points = pointsOf(mesh);
  const BakeOptions options = optionsOf(TransferKind::shadowed, 2, 64);
  TransferSet baked = bakeAll(points, options).transfer;
  const std::uint32_t wrong = pointOfVertex(points, 12);
  std::fill_n(&baked.coefficients[wrong * baked.stride()], baked.stride(), 0.0f);
  const SurfaceError e = measure(points, baked, options, 4096);
  // Six faces of area 1/2, over each of which the mean of the squared weight of a corner is 1/6, of an area of 16.
  CHECK(std::abs(square(e) - 3.0 / 6 / 16) < 4 * errorOfSquare(e));
  // 4096 samples on 16 squares: the nearest of some hundred on the six faces is within 0.2 of the vertex.
  CHECK((e.worst > 0.8 && e.worst < 1));
  CHECK(length(e.worstPosition - Vec3d(12, 22, 0)) < 0.3);
  CHECK(e.worstPosition.z == Approx(0).margin(1e-6));
}

TEST_CASE("the noise of the rays is subtracted without bias", "[surface_error]") {
  // Truth is known at the corners and linear between; the baked transfer is off by a known offset everywhere.
  const Mesh mesh = smallFloorBesideWall();
  const LightingPoints points = pointsOf(mesh);
  constexpr int kOrder = 3;
  const double offset = 0.005;
  BakeOptions options = optionsOf(TransferKind::shadowed, kOrder, 16);
  TransferSet exact;
  exact.order = kOrder;
  exact.coefficients.assign(points.size() * 9, 0);
  for (std::uint32_t v = 0; v < 4; ++v) {
    const Vec3d n(0, 0, 1);
    std::vector<double> t = openTransfer(kOrder, n);
    add(t, transferThrough(kOrder, n, Vec3d(1, 1.5, 0.3) - mesh.positions[v], {0, -2.5, 0}, {0, 0, 1.7}, 1), -1);
    t[0] += offset * sh::unshadowedNorm(kOrder);
    std::copy(t.begin(), t.end(), &exact.coefficients[pointOfVertex(points, v) * 9]);
  }
  constexpr int kSeeds = 24;
  // Sets of more rays than the bake's, of as many, and of the least.
  for (const TruthRays& rays : {TruthRays{4, 16}, TruthRays{1, 16}, TruthRays{1, 512}}) {
    const int count = std::max(rays.perRay * options.rays, rays.least);
    INFO(count << " rays");
    Samples squares, noise;
    for (int seed = 0; seed < kSeeds; ++seed) {
      options.seed = static_cast<std::uint64_t>(seed);
      const SurfaceError measured = measure(points, exact, options, 256, 2, 1, rays);
      CHECK(measured.rays == 2 * count);
      squares.add(std::vector<double>{square(measured)});
      // The variance of one set.
      const TransferSet traced =
          bakeAll(points, optionsOf(TransferKind::shadowed, kOrder, count, options.seed)).transfer;
      double variance = 0;
      for (std::uint32_t v = 0; v < 4; ++v) {
        const auto row = traced.at(pointOfVertex(points, v), 0), truth = exact.at(pointOfVertex(points, v), 0);
        for (std::size_t k = 0; k < 9; ++k) {
          const double off = k == 0 ? offset * sh::unshadowedNorm(kOrder) : 0;
          variance += std::pow((double(row[k]) - double(truth[k]) + off) / sh::unshadowedNorm(kOrder), 2) / 4;
        }
      }
      noise.add(std::vector<double>{variance});
    }
    const double limit = errorLimit(1, kSeeds) * squares.standardError(0);
    CHECK(std::abs(squares.mean(0) - offset * offset) < limit);
    // Left in, the noise of the mean of two sets would be found out.
    CHECK(noise.mean(0) / 2 > 3 * limit);
  }
}

TEST_CASE("unshadowed transfer is measured in closed form", "[surface_error]") {
  Mesh mesh;
  mesh.source = "triangle";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.vertexNormals.assign(3, {0, 0, 1});
  Albedo albedo;
  albedo.per = Albedo::Per::vertex;
  albedo.values = {{1, 0.5f, 0.2f}, {0.1f, 0.6f, 0.9f}, {0, 0, 0}};
  const BakeOptions options = optionsOf(TransferKind::unshadowed, 4, 0);
  Progress progress;

  SECTION("a linear field has no error") {
    const LightingPoints points = makeLightingPoints(mesh, {}, albedo, progress);
    const SurfaceError e = measure(points, bakeAll(points, options).transfer, options);
    CHECK(e.samples == 1024);
    CHECK(e.rays == 0);
    CHECK(e.worst < kRounding);
  }
  SECTION("normals that turn have that of interpolated coefficients") {
    mesh.vertexNormals = {Vec3f(normalized(Vec3d(-0.3, -0.4, 1))), Vec3f(normalized(Vec3d(0.5, 0, 1))),
                          Vec3f(normalized(Vec3d(0, 0.6, 1)))};
    const LightingPoints points = makeLightingPoints(mesh, {}, albedo, progress);
    const TransferSet baked = bakeAll(points, options).transfer;
    double sum = 0, count = 0;
    overFaces(points, 60, [&](std::size_t f, const std::array<double, 3>& w) {
      const Triangle& corners = points.facePoints[f];
      const Vec3d n =
          normalized(blended<Vec3d>(w, [&](std::size_t k) { return Vec3d(points.pointNormal[corners[k]]); }));
      const Vec3d rho = blended<Vec3d>(w, [&](std::size_t k) { return Vec3d(points.pointAlbedo[corners[k]]); });
      const double channels[] = {rho.x, rho.y, rho.z};
      double difference = 0, scale = 0;
      for (int c = 0; c < 3; ++c) {
        const std::vector<double> truth = openTransfer(4, n, channels[c]);
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const double t = blended<double>(w, [&](std::size_t k) { return double(baked.at(corners[k], c)[i]); });
          difference += std::pow(t - truth[i], 2);
          scale += std::pow(truth[i], 2);
        }
      }
      sum += difference / scale;
      ++count;
    });
    const SurfaceError e = measure(points, baked, options);
    REQUIRE(sum / count > 1e-4);
    CHECK(std::abs(square(e) - sum / count) < 4 * errorOfSquare(e));
  }
}

TEST_CASE("a face hides what lies below it from normals that lean", "[surface_error]") {
  // The normals lean 40 degrees, to the side and to the back: the face hides the share (1 - cos 40)/2 of their sky.
  const double lean = 40 * kPi / 180, offset = 0.01;
  const auto azimuth = GENERATE(0.0, 2.0, 4.0);
  Mesh mesh = shapes::grid({}, {1, 0, 0}, {0, 1, 0});
  mesh.vertexNormals.assign(
      4, Vec3f(Vec3d(std::sin(lean) * std::cos(azimuth), std::sin(lean) * std::sin(azimuth), std::cos(lean))));
  const LightingPoints points = pointsOf(mesh);
  TransferSet seen;
  seen.order = 1;
  seen.coefficients.assign(points.size(), float(sh::unshadowedNorm(1) * ((1 + std::cos(lean)) / 2 + offset)));
  const SurfaceError e = measure(points, seen, optionsOf(TransferKind::shadowed, 1, 1024), 256);
  CHECK(std::abs(square(e) - offset * offset) < 4 * errorOfSquare(e) + offset * kRounding);
}

TEST_CASE("sheets of two sides and tiles laid on a floor hide nothing from each other", "[surface_error]") {
  const Mesh floor = shapes::grid({}, {4, 0, 0}, {0, 4, 0}, 2, 2),
             tile = shapes::grid({0.7, 1.1, 0}, {1, 0, 0}, {0, 2, 0});
  const Mesh sheet = shapes::merged(shapes::merged(floor, shapes::flipped(floor)), tile);
  const LightingPoints points = pointsOf(shapes::rotated(sheet, shapes::rotationAbout({3, 1, 2}, 1)));
  const BakeOptions options = optionsOf(TransferKind::shadowed, 3, 64);
  CHECK(measure(points, bakeAll(points, options).transfer, options).worst < kRounding);
}

TEST_CASE("reflections that are counted reach samples as often as vertices", "[surface_error]") {
  // A small floor within an open cavity is as exact as its corners: its samples find what these lack of the truth.
  const double e = 5e-4;
  const Mesh mesh = shapes::merged(shapes::grid({-e, -e, 0}, {2 * e, 0, 0}, {0, 2 * e, 0}),
                                   shapes::rotated(shapes::openCavity(2, 0, 60), shapes::rotationAbout({1, 0, 0}, 1)));
  const LightingPoints points = pointsOf(mesh, {0.9f, 0.9f, 0.9f});
  for (const int bounces : {0, 1, 2, BakeOptions::kBouncesAuto}) {
    INFO(bounces << " bounces");
    BakeOptions options = optionsOf(TransferKind::interreflected, 3, 2048);
    options.bounces = bounces;
    options.tolerance = 1e-4;
    const PointBake baked = bakeAll(points, options);
    double stated = 0;
    for (std::uint32_t v = 0; v < 4; ++v) {
      stated = std::max(stated, double(baked.transfer.error[pointOfVertex(points, v)]));
    }
    CHECK(measure(points, baked.transfer, options, 16, 2).rms < 4 * stated);
    if (bounces == BakeOptions::kBouncesAuto) continue;
    // One reflection more would be missed.
    options.bounces = bounces + 1;
    CHECK(measure(points, baked.transfer, options, 16, 2).rms > 8 * stated);
  }
}

TEST_CASE("black faces have no relative error", "[surface_error]") {
  const BakeOptions options = optionsOf(TransferKind::shadowed, 2, 64);
  const LightingPoints black = pointsOf(floorAndWall(2), {0, 0, 0});
  CHECK(measure(black, bakeAll(black, options).transfer, options) == SurfaceError());
  // A black wall: samples lie on the floor alone.
  Mesh mesh = shapes::merged(shapes::colored(shapes::grid({}, {1, 0, 0}, {0, 1, 0}), {0.5f, 0.5f, 0.5f}),
                             shapes::colored(shapes::grid({}, {0, 1, 0}, {0, 0, 1}), {0, 0, 0}));
  mesh.faceColorEncoding = ColorEncoding::linear;
  const LightingPoints points = pointsOf(mesh);
  const TransferSet baked = bakeAll(points, options).transfer;
  const SurfaceError all = measure(points, baked, options, 64), floor = measure(points, baked, options, 64, 2);
  CHECK(all == floor);
  CHECK(all.worstPosition.z == Approx(0).margin(1e-6));
}

TEST_CASE("the surface error does not depend on threads", "[surface_error]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(0), {0.5f, 0.6f, 0.7f});
  BakeOptions options = optionsOf(TransferKind::interreflected, 2, 64);
  const TransferSet baked = bakeAll(points, options).transfer;
  CHECK(measure(points, baked, options, 65, 0, 1) == measure(points, baked, options, 66, 0, 2));
  options.seed = 2;
  CHECK_FALSE(measure(points, baked, options, 65) == measure(points, baked, optionsOf(options.kind, 2, 64), 65));
}

TEST_CASE("surface errors that cannot be measured are refused", "[surface_error]") {
  const LightingPoints points = pointsOf(floorAndWall(1));
  BakeOptions options = optionsOf(TransferKind::shadowed, 2, 64);
  const TransferSet baked = bakeAll(points, options).transfer;
  CHECK_THROWS_WITH(measure(points, baked, options, 15), Catch::Contains("surface samples, 15, is out of range"));
  CHECK_THROWS_WITH(measure(points, baked, options, (1 << 20) + 1), Catch::Contains("16 to 1048576"));
  options.order = 3;
  CHECK_THROWS_WITH(measure(points, baked, options), Catch::Contains("does not belong to these points"));
  options.order = 2;
  options.rays = 0;
  CHECK_THROWS_WITH(measure(points, baked, options), Catch::Contains("needs the number of rays"));
  CHECK_THROWS_WITH(measure(pointsOf(floorAndWall(2)), baked, optionsOf(options.kind, 2, 64)),
                    Catch::Contains("does not belong to these points"));
}

TEST_CASE("measuring the surface counts and stops", "[surface_error]") {
  const LightingPoints points = pointsOf(floorAndWall(4));
  const BakeOptions options = optionsOf(TransferKind::shadowed, 2, 64);
  const TransferSet baked = bakeAll(points, options).transfer;
  checkStopping(
      [&](Progress& progress) {
        const Parallel parallel(1);
        measureSurfaceError(points, baked, options, {64, 0}, parallel, progress);
      },
      {{"placing samples", double(points.faces.size())},
       {"twin faces", double(points.faces.size())},
       {"building", 1},
       {"searching contacts", 4096},
       {"measuring the surface", 1024}});
}
