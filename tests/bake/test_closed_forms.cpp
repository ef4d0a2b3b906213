// Shadowed transfer against closed forms and independent quadrature: convex bodies, walls, corners, discs, furnaces.
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/closed_forms.h"
#include "bake/direction_set.h"
#include "bake/support.h"
#include "sh/basis.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr int kOrder = 4;
constexpr int kRays = 4096;
constexpr int kSeeds = 64;

/// How far the expectation over turns of the lattice may lie from the integral, for degree l:
/// - The control variate adds the visible share of the residual. Turns leave of it the part that does not turn, m = 0,
///   and what correlates with the share, whose standard deviation is below 1 % at these ray counts.
/// - Averaged over turns, a ring's mean is a function of sin^2 with one rise and one fall of at most sqrt((2l+1)/4pi);
///   the midpoints' discrepancy is 1/(2N) (Koksma).
double biasBound(const DirectionSet& set, int l) {
  double fixed = 0, all = 0;
  for (int m = -l; m <= l; ++m) {
    const double r = set.residual()[static_cast<std::size_t>(sh::index(l, m))];
    all += r * r;
    if (m == 0) fixed = std::abs(r);
  }
  return fixed + 0.01 * std::sqrt(all) + std::sqrt((2 * l + 1) / (4 * kPi)) / set.size();
}

/// Checks a point's mean transfer over seeds against the exact one, and its sky factor.
void checkPoint(const LightingPoints& points, std::uint32_t p, const std::vector<double>& exact) {
  Samples transfer, sky;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const PointBake bake = bakeSome(points, {p}, optionsOf(TransferKind::shadowed, kOrder, kRays, std::uint64_t(seed)));
    transfer.add(bake.transfer.at(p, 0));
    const double v[] = {double(bake.transfer.visibility[p])};
    sky.add(v);
  }
  const DirectionSet set(kRays, kOrder);
  const double limit = errorLimit(exact.size() + 1, kSeeds);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double allowed = limit * transfer.standardError(i) + biasBound(set, sh::degreeOf(int(i))) + kHalfUlp;
    INFO("point " << p << ", coefficient " << i << ": " << transfer.mean(i) << " against " << exact[i]);
    CHECK(std::abs(transfer.mean(i) - exact[i]) <= allowed);
    // The comparison means something: it resolves 2e-3 of an open point's transfer.
    CHECK(allowed < 2e-3);
  }
  const double factor = exact[0] * std::sqrt(4 * kPi);
  CHECK(std::abs(sky.mean(0) - factor) <= limit * sky.standardError(0) + 1.0 / kRays);
}

std::vector<Vec3d> seenFrom(const Vec3d& p, std::vector<Vec3d> polygon) {
  for (Vec3d& v : polygon) v -= p;
  return polygon;
}

}  // namespace

TEST_CASE("on a convex body, shadowed transfer is the unshadowed one", "[closed_forms]") {
  for (const Mesh& mesh : shapes::convexSolids()) {
    for (const auto normals : {NormalSource::smooth, NormalSource::flat}) {
      const LightingPoints points = pointsOf(mesh, {0.5f, 0.5f, 0.5f}, {.normals = normals});
      const PointBake shadowed = bakeAll(points, optionsOf(TransferKind::shadowed, kOrder, 64));
      const PointBake open = bakeAll(points, optionsOf(TransferKind::unshadowed, kOrder, 64));
      INFO(mesh.source);
      for (const float v : shadowed.transfer.visibility) REQUIRE(v == 1);
      for (std::size_t i = 0; i < open.transfer.coefficients.size(); ++i) {
        // Both round one double to float, after a rotation that is exact to 1e-14.
        REQUIRE(std::abs(double(shadowed.transfer.coefficients[i]) - double(open.transfer.coefficients[i])) <
                2 * kHalfUlp);
      }
      CHECK(shadowed.rmsError == 0);
    }
  }
}

TEST_CASE("extreme slivers do not shadow the convex bodies they are part of", "[closed_forms]") {
  // Needles, lenses and cones of thousands of sides: faces up to a million times longer than wide.
  Mesh lens = shapes::icosphere(4);
  for (Vec3d& p : lens.positions) p.z *= 1e-4;
  for (const Mesh& mesh : {lens, shapes::bicone(3, 1e6), shapes::bicone(20000, 0.5), shapes::bicone(20000, 1e-4)}) {
    for (const double angle : {0.0, 0.7}) {
      const LightingPoints points = pointsOf(shapes::rotated(mesh, shapes::rotationAbout({1, 2, 3}, angle)));
      std::vector<std::uint32_t> some;
      for (std::uint32_t p = 0; p < points.size(); p += std::uint32_t(1 + points.size() / 200)) some.push_back(p);
      const PointBake bake = bakeSome(points, some, optionsOf(TransferKind::shadowed, 1, 256));
      INFO(mesh.source << " of " << points.size() << " points, turned by " << angle);
      // Vertices are rounded to float: a solid is convex to that rounding only, and grazing directions may meet it.
      // Directions rise at least sqrt(1/512) above the tangent plane: only a mesh that is not convex to 2.5 degrees
      // could block one.
      float least = 1;
      for (const std::uint32_t p : some) least = std::min(least, bake.transfer.visibility[p]);
      CHECK(least == 1);
    }
  }
}

TEST_CASE("unshadowed transfer is the closed form at every point", "[closed_forms]") {
  const LightingPoints points = pointsOf(shapes::city(1, 1, 2), {0.25f, 0.5f, 1});
  const PointBake bake = bakeAll(points, optionsOf(TransferKind::unshadowed, 8, 0));
  CHECK(bake.rays == 0);
  CHECK(bake.transfer.channels == 3);
  const double albedo[] = {0.25, 0.5, 1};
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      const auto exact = openTransfer(8, normalized(Vec3d(points.pointNormal[p])), albedo[c]);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        REQUIRE(std::abs(double(bake.transfer.at(p, c)[i]) - exact[i]) <= 2 * kHalfUlp * std::abs(exact[i]) + 1e-14);
      }
    }
  }
}

TEST_CASE("white furnace: under constant light an open point sends out its albedo", "[closed_forms]") {
  for (const float albedo : {0.0f, 0.18f, 0.8f, 1.0f}) {
    const LightingPoints points =
        pointsOf(shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3), {albedo, albedo, albedo});
    const PointBake bake = bakeAll(points, optionsOf(TransferKind::interreflected, 3, 256));
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      // Radiance 1 from everywhere has the single coefficient sqrt(4 pi). Two roundings: the coefficient, the product.
      const double out = std::sqrt(4 * kPi) * double(bake.transfer.at(p, 0)[0]);
      CHECK(std::abs(out - double(albedo)) <= 2 * kHalfUlp * double(albedo));
    }
  }
}

TEST_CASE("a floor beside a wall, against Lambert's polygon and the infinite wall", "[closed_forms]") {
  for (const auto& [height, distance] : {std::pair{1.0, 1.0}, {2.0, 0.5}, {0.3, 1.0}}) {
    const double extent = 8;
    const LightingPoints points = pointsOf(shapes::floorBesideWall(height, distance, extent));
    const std::uint32_t origin = pointOfVertex(points, 0);
    const double hidden = formFactor(
        {0, 0, 1},
        {{distance, -extent, 0}, {distance, extent, 0}, {distance, extent, height}, {distance, -extent, height}});
    // Beyond |y| = extent an infinite wall would hide z d / (pi r^4) an area at r >= |y|: H^2 d / (3 pi extent^3).
    const double k = height / distance;
    CHECK(std::abs(hidden - (1 - 1 / std::sqrt(1 + k * k)) / 2) <=
          height * height * distance / (3 * kPi * std::pow(extent, 3)));
    std::vector<double> exact = openTransfer(kOrder, {0, 0, 1});
    const auto wall =
        transferThrough(kOrder, {0, 0, 1}, {distance, -extent, 0}, {0, 2 * extent, 0}, {0, 0, height}, 16);
    CHECK(wall[0] * std::sqrt(4 * kPi) == Approx(hidden).epsilon(1e-9));  // quadrature against Lambert
    add(exact, wall, -1);
    checkPoint(points, origin, exact);
  }
}

TEST_CASE("a floor point in the corner of three squares sees what two finite walls leave", "[closed_forms]") {
  const int n = 4;
  const Mesh mesh = shapes::corner(n);
  const LightingPoints points = pointsOf(mesh);
  int checked = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const Vec3d at = points.filePosition(p);
    if (points.pointNormal[p].z < 0.99f || at.x < 0.2 || at.y < 0.2 || at.x > 0.6) continue;
    if (at.y != 0.25 && at.y != 0.75) continue;
    std::vector<double> exact = openTransfer(kOrder, {0, 0, 1});
    double factor = 1;
    for (const bool first : {true, false}) {
      const Vec3d along = first ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0), up(0, 0, 1);
      add(exact, transferThrough(kOrder, {0, 0, 1}, -at, along, up, 4), -1);
      factor -= formFactor({0, 0, 1}, seenFrom(at, {{0, 0, 0}, along, along + up, up}));
    }
    CHECK(exact[0] * std::sqrt(4 * kPi) == Approx(factor).epsilon(1e-9));
    checkPoint(points, p, exact);
    ++checked;
  }
  CHECK(checked == 4);
}

TEST_CASE("at a crease and in a corner each face sees the one-sided limit", "[closed_forms]") {
  const LightingPoints points = pointsOf(shapes::corner(4));
  int creases = 0, corners = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const Vec3d at = points.filePosition(p);
    if (points.pointNormal[p].z < 0.99f) continue;
    if (at == Vec3d(0, 0, 0)) {
      checkPoint(points, p, transferOfSector(kOrder, 0, kPi / 2));
      ++corners;
    } else if (at == Vec3d(0, 0.5, 0)) {
      // Half the sky is behind the wall at distance zero; of the rest, the other wall hides its share.
      std::vector<double> exact = transferOfSector(kOrder, -kPi / 2, kPi / 2);
      add(exact, transferThrough(kOrder, {0, 0, 1}, Vec3d(0, -0.5, 0), {1, 0, 0}, {0, 0, 1}, 4), -1);
      checkPoint(points, p, exact);
      ++creases;
    }
  }
  CHECK(creases == 1);
  CHECK(corners == 1);
}

TEST_CASE("a coaxial disc hides what its polygon does", "[closed_forms]") {
  for (const auto& [radius, height, segments] : {std::tuple{1.0, 1.0, 64}, {2.0, 0.5, 24}, {0.3, 1.0, 5}}) {
    const LightingPoints points = pointsOf(shapes::discAboveFloor(radius, height, segments));
    std::vector<Vec3d> polygon;
    for (int i = 0; i < segments; ++i) {
      const double phi = 2 * kPi * i / segments;
      polygon.push_back({radius * std::cos(phi), radius * std::sin(phi), height});
    }
    const double hidden = formFactor({0, 0, 1}, polygon);
    // The polygon lies between its inscribed and circumscribed circles.
    const double inner = std::pow(radius * std::cos(kPi / segments), 2), outer = radius * radius;
    CHECK(hidden >= inner / (inner + height * height));
    CHECK(hidden <= outer / (outer + height * height));
    std::vector<double> exact = openTransfer(kOrder, {0, 0, 1});
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      add(exact,
          transferThroughTriangle(kOrder, {0, 0, 1}, {0, 0, height}, polygon[i], polygon[(i + 1) % polygon.size()], 2),
          -1);
    }
    CHECK(exact[0] * std::sqrt(4 * kPi) == Approx(1 - hidden).epsilon(1e-8));
    checkPoint(points, pointOfVertex(points, 0), exact);
  }
}

TEST_CASE("a red floor reddens a white wall by the floor's form factor", "[closed_forms]") {
  const int n = 12;
  const Mesh mesh = shapes::redFloorWhiteWall(n);
  const LightingPoints points = pointsOf(mesh);
  std::uint32_t wall = LightingPoints::kNone;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    const Vec3d at = points.filePosition(p);
    if (length(at - Vec3d(0, 0.5, 0.5)) < 1e-6 && points.pointNormal[p].x > 0.9f) wall = p;
  }
  REQUIRE(wall != LightingPoints::kNone);

  // One reflection: the floor at q sends out sky(q); the wall receives it times z_p x_q / (pi r^4) an area.
  const Vec3d p(0, 0.5, 0.5);
  double exact = 0, shareOfFloor = 0;
  const int steps = 200;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vec3d q((i + 0.5) / steps, (j + 0.5) / steps, 0), d = q - p;
      const double sky = 1 - formFactor({0, 0, 1}, seenFrom(q, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}));
      const double kernel = d.x * -d.z / (kPi * std::pow(dot(d, d), 2)) / (steps * steps);
      exact += sky * kernel;
      shareOfFloor += kernel;
    }
  }
  Samples bleed;
  double green = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    BakeOptions options = optionsOf(TransferKind::interreflected, 1, 1024, seed);
    options.bounces = 1;
    const PointBake bake = bakeAll(points, options);
    REQUIRE(bake.transfer.channels == 3);
    green = double(bake.transfer.at(wall, 1)[0]) * std::sqrt(4 * kPi);
    const double added[] = {double(bake.transfer.at(wall, 0)[0]) * std::sqrt(4 * kPi) - green};
    bleed.add(added);
    CHECK(bake.transfer.at(wall, 1)[0] == bake.transfer.at(wall, 2)[0]);  // nothing green or blue is sent up
  }
  // The floor's sky factor is interpolated over cells of 1/n: 1/(8 n^2) of its second derivatives, which for a wall of
  // height 1 stay below 0.43 across it and, as the walls' ends are like edges of it, along it. In the two cells at the
  // wall's ends the limit depends on the side from which it is taken: there it errs by at most 1/2 over 1/n^2 each. The
  // midpoint sums of the quadrature add 1/(24 steps^2) of second derivatives below 100.
  const double interpolation = shareOfFloor * 2 * 0.43 / (8.0 * n * n);
  const double kernelAtEnds = 0.5 / (kPi * 0.25) / n;  // x_q <= 1/n, z_p = 1/2, r^2 >= 1/2
  const double ends = 2 * 0.5 * kernelAtEnds / (n * n);
  const double quadrature = 100.0 / (24 * steps * steps);
  INFO("bleeding " << bleed.mean(0) << " against " << exact);
  CHECK(std::abs(bleed.mean(0) - exact) <=
        errorLimit(1, 24) * bleed.standardError(0) + interpolation + ends + quadrature);
  // The floor cannot be seen from above the wall's foot alone: the wall's own sky is half the sphere it faces, open.
  const double ratio = (green + exact) / green;
  CHECK(ratio > 1.05);
  CHECK((green + bleed.mean(0)) / green == Approx(ratio).margin((interpolation + ends + quadrature + 1e-3) / green));
}
