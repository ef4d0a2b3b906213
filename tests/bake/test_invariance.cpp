// Bakes do not depend on units, place, orientation, the order of a file, or threads; seeds are independent samples.
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/support.h"
#include "sh/rotation.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

BakeOptions options(std::uint64_t seed, int rays = 64) {
  BakeOptions o = optionsOf(TransferKind::interreflected, 3, rays, seed);
  o.bounces = 3;
  return o;
}

/// Transfer of every corner of every face in the mesh's own order, channel by channel: what a viewer sees, however
/// points are numbered.
std::vector<double> atCorners(const LightingPoints& points, const PointBake& bake) {
  std::vector<double> values;
  for (const Triangle& face : points.outputFaces) {
    for (const std::uint32_t o : face) {
      const auto t = std::span(bake.transfer.coefficients).subspan(points.outputPoint[o] * bake.transfer.stride());
      values.insert(values.end(), t.begin(), t.begin() + std::ptrdiff_t(bake.transfer.stride()));
    }
  }
  return values;
}

std::vector<double> cornersOf(const Mesh& mesh, std::uint64_t seed, int rays = 64) {
  const LightingPoints points = pointsOf(mesh);
  return atCorners(points, bakeAll(points, options(seed, rays)));
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

/// A room with coloured walls: 27 coefficients at each of some hundred points.
const Mesh& room() {
  static const Mesh mesh = shapes::cornellRoom(4);
  return mesh;
}

/// The RMS difference of two seeds is sqrt(2) times a bake's own error. A changed mesh with a third seed must differ
/// from the first by the same, not more: over thousands of values with some hundred independent points the ratio's
/// standard deviation is a few percent, and an error of its own of 2/3 of a bake's would already show at 1.2.
void checkSame(const std::vector<double>& changed) {
  static const double between = rms(cornersOf(room(), 1), cornersOf(room(), 2));
  const double ratio = rms(cornersOf(room(), 1), changed) / between;
  INFO("ratio " << ratio);
  CHECK(ratio < 1.2);
  CHECK(ratio > 1 / 1.2);  // another sample, not the same
}

}  // namespace

TEST_CASE("units do not matter", "[invariance]") {
  for (const double factor : {1e4, 1e-4, 1e12, 1e-12}) checkSame(cornersOf(shapes::scaled(room(), factor), 3));
}

TEST_CASE("units by powers of two and exact shifts do not change a bit", "[invariance]") {
  // Coordinates in multiples of 1/16, so that scaling and shifting by integers are exact.
  const Mesh mesh = shapes::corner(4);
  const LightingPoints points = pointsOf(mesh);
  const PointBake bake = bakeAll(points, options(1));
  for (const Mesh& changed : {shapes::scaled(mesh, 0x1p40), shapes::scaled(mesh, 0x1p-40),
                              shapes::translated(mesh, {1 << 20, -(1 << 20), 64})}) {
    CHECK(sameBits(bakeAll(pointsOf(changed), options(1)).transfer.coefficients, bake.transfer.coefficients));
  }
}

TEST_CASE("place does not matter", "[invariance]") {
  // A hundred diagonals away, in doubles: 100 * 2^-53 of the size is lost, nothing in float.
  checkSame(cornersOf(shapes::translated(room(), {300, -170, 90}), 3));
}

TEST_CASE("orientation does not matter: light turned back is the same", "[invariance]") {
  for (const auto& [axis, angle] : {std::pair{Vec3d(0, 0, 1), kPi / 2}, {Vec3d(1, 2, 3), 1.0}, {Vec3d(1, 0, 0), kPi}}) {
    const shapes::Matrix3 turn = shapes::rotationAbout(axis, angle);
    const std::vector<double> turned = cornersOf(shapes::rotated(room(), turn), 3);
    sh::Matrix3d matrix;
    for (std::size_t r = 0; r < 3; ++r) {
      matrix(int(r), 0) = turn[r].x;
      matrix(int(r), 1) = turn[r].y;
      matrix(int(r), 2) = turn[r].z;
    }
    const sh::Rotation back = sh::Rotation(3, matrix).inverse();
    std::vector<double> values(turned.size());
    for (std::size_t i = 0; i < turned.size(); i += 9) {
      back.apply(std::span(turned).subspan(i, 9), std::span(values).subspan(i, 9));
    }
    checkSame(values);
  }
}

TEST_CASE("the order of vertices, faces and corners does not matter", "[invariance]") {
  const LightingPoints points = pointsOf(room());
  const PointBake bake = bakeAll(points, options(1));
  const shapes::Shuffled shuffled = shapes::shuffled(room(), 5);
  const LightingPoints again = pointsOf(shuffled.mesh);
  const PointBake other = bakeAll(again, options(1));
  REQUIRE(again.size() == points.size());
  // Points are numbered by their geometry, so the rays are the same; barycentric weights of turned corners round
  // differently (1/65535 of a face a hit), and rays within rounding of an edge may meet the other face.
  const double between = rms(cornersOf(room(), 1), cornersOf(room(), 2));
  double sum = 0;
  for (std::size_t i = 0; i < bake.transfer.coefficients.size(); ++i) {
    sum += std::pow(double(bake.transfer.coefficients[i]) - double(other.transfer.coefficients[i]), 2);
  }
  CHECK(std::sqrt(sum / double(bake.transfer.coefficients.size())) < between / 100);
}

TEST_CASE("the same bytes on any number of threads and every run", "[invariance]") {
  const LightingPoints points = pointsOf(room());
  BakeOptions solved = options(1);
  solved.bounces = BakeOptions::kBouncesAuto;
  BakeOptions chosen = solved;
  chosen.rays = 0;
  chosen.tolerance = 0.05;
  BakeOptions shadowed = options(1);
  shadowed.kind = TransferKind::shadowed;
  for (const BakeOptions& o : {options(1), solved, chosen, shadowed}) {
    const PointBake one = bakeAll(points, o, 1);
    for (const int threads : {1, 2, 3}) {
      const PointBake more = bakeAll(points, o, threads);
      CHECK(sameBits(more.transfer.coefficients, one.transfer.coefficients));
      CHECK(sameBits(more.transfer.error, one.transfer.error));
      CHECK(sameBits(more.transfer.visibility, one.transfer.visibility));
      CHECK(more.rays == one.rays);
      CHECK(more.rmsError == one.rmsError);
      CHECK(more.bounces == one.bounces);
    }
  }
}

TEST_CASE("the mean over seeds is the mean of many rays", "[invariance]") {
  // 32 bakes of 64 rays against 8 of 4096: their means agree within standard errors, and within the bias that the
  // lattice's residual leaves in the control variate: at most that residual times the visible share, which shrinks with
  // the rays. The residual's m = 0 part is 0.07 N^-1.5 for l = 1 and below 1/(2N) of the basis in general.
  const Mesh mesh = shapes::cornellRoom(2);
  const LightingPoints points = pointsOf(mesh);
  Samples few, many;
  for (std::uint64_t seed = 1; seed <= 32; ++seed) few.add(bakeAll(points, options(seed, 64)).transfer.coefficients);
  for (std::uint64_t seed = 101; seed <= 108; ++seed) {
    many.add(bakeAll(points, options(seed, 4096)).transfer.coefficients);
  }
  const double limit = errorLimit(few.size(), 32), limitMany = errorLimit(few.size(), 8);
  double squares = 0, expected = 0, bias = 0;
  for (std::size_t i = 0; i < few.size(); ++i) {
    const double a = few.standardError(i), b = many.standardError(i), difference = few.mean(i) - many.mean(i);
    // Koksma: ring means as functions of sin^2 rise and fall by at most the basis's largest value, here below 1.
    CHECK(std::abs(difference) <= limit * a + limitMany * b + 1.0 / 64);
    squares += difference * difference;
    expected += a * a + b * b;
    bias += difference;
  }
  // Over all coefficients: the squared differences are what the standard errors predict, and a bias of a tenth of a
  // single bake's error (sqrt(32) standard errors) would raise their sum by a third.
  INFO("ratio " << squares / expected << ", mean difference " << bias / double(few.size()));
  CHECK(squares / expected < 1.33);
}
