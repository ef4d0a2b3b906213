// The bowl: the inside of a sphere with a polar hole, for which every number of reflections has a closed form.
//
// Between any two patches of a sphere the form factor is constant. With f = (1 + cos a) / 2 the wall's share of the
// sphere, a the hole's half-angle and albedo rho, the mean direct transfer over the wall is
//   <T_lm> = rho sin^2 a / (4 pi f) A_l y_lm(z),
// and reflection k adds (rho f)^k <T> at every point of the wall.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "bake/closed_forms.h"
#include "bake/support.h"
#include "sh/basis.h"
#include "sh/irradiance.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr int kOrder = 3, kRings = 24, kSectors = 48;  // of the meshes, where nothing else is said

struct Bowl {
  double aperture, f;
  Mesh mesh;
  LightingPoints points;
  double edge;  // the longest edge, as an angle at the centre
};

Bowl makeBowl(double degrees, float albedo, int rings = kRings, int sectors = kSectors) {
  const double a = degrees * kPi / 180;
  Bowl bowl{a, (1 + std::cos(a)) / 2, shapes::bowl(a, rings, sectors, true), {}, 0};
  bowl.points = pointsOf(bowl.mesh, {albedo, albedo, albedo});
  for (const Triangle& t : bowl.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      bowl.edge = std::max(bowl.edge, angleBetween(bowl.mesh.positions[t[k]], bowl.mesh.positions[t[(k + 1) % 3]]));
    }
  }
  return bowl;
}

std::vector<double> meanDirect(const Bowl& bowl, double albedo) {
  std::vector<double> y(kOrder * kOrder), mean(y.size());
  sh::evaluate(kOrder, Vec3d(0, 0, 1), y);
  const double sine = std::sin(bowl.aperture);
  for (std::size_t i = 0; i < y.size(); ++i) {
    mean[i] = albedo * sine * sine / (4 * kPi * bowl.f) * sh::cosineLobe(sh::degreeOf(int(i))) * y[i];
  }
  return mean;
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// The hole as the mesh has it: a regular polygon in the plane z = cos a.
std::vector<Vec3d> holeFrom(const Bowl& bowl, const Vec3d& p) {
  std::vector<Vec3d> polygon;
  for (int s = 0; s < kSectors; ++s) polygon.push_back(bowl.mesh.positions[std::size_t(s)] - p);
  return polygon;
}

PointBake bake(const Bowl& bowl, int bounces, int rays = 256, std::uint64_t seed = 1) {
  BakeOptions options = optionsOf(TransferKind::interreflected, kOrder, rays, seed);
  options.bounces = bounces;
  options.tolerance = 1e-3;
  return bakeAll(bowl.points, options);
}

}  // namespace

TEST_CASE("each ring of a bowl sees the sky through its polygonal hole", "[bowl]") {
  for (const double degrees : {30.0, 60.0, 90.0, 150.0}) {
    const Bowl bowl = makeBowl(degrees, 1);
    const PointBake baked = bake(bowl, 0);
    const double limit = errorLimit(4 * kRings, kSectors);
    for (int ring = 1; ring < kRings; ++ring) {
      // The mesh maps onto itself by a turn of one sector: a ring's points are independent samples of one value.
      Samples sky;
      Vec3d at;
      for (int s = 0; s < kSectors; ++s) {
        const auto v = std::uint32_t(ring * kSectors + s);
        at = bowl.mesh.positions[v];
        const double sample[] = {double(baked.transfer.visibility[pointOfVertex(bowl.points, v)])};
        sky.add(sample);
      }
      const double exact = formFactor(at * -1.0, holeFrom(bowl, at));
      INFO(degrees << " degrees, ring " << ring << ": " << sky.mean(0) << " against " << exact);
      // Koksma: ring means as functions of sin^2 rise and fall by at most 1.
      CHECK(std::abs(sky.mean(0) - exact) <= limit * sky.standardError(0) + 1.0 / 256);
      // And the polygon's value is the sphere's but for its area: (2 pi / n)^2 / 6 of the hole's share, 1 - f; near the
      // rim the missing segments subtend up to all of it.
      if (ring > 3) CHECK(std::abs(exact - (1 - bowl.f)) <= 4 * (1 - bowl.f) * std::pow(2 * kPi / kSectors, 2) / 6);
    }
  }
}

TEST_CASE("direct transfer in a bowl is the integral over its hole", "[bowl]") {
  for (const double degrees : {30.0, 90.0, 150.0}) {
    const Bowl bowl = makeBowl(degrees, 1);
    for (const int ring : {8, 16, 23}) {
      const auto v = std::uint32_t(ring * kSectors + 5);
      const Vec3d at = bowl.mesh.positions[v];
      const std::uint32_t p = pointOfVertex(bowl.points, v);
      const std::vector<Vec3d> hole = holeFrom(bowl, at);
      std::vector<double> exact(kOrder * kOrder, 0);
      const Vec3d centre = Vec3d(0, 0, std::cos(bowl.aperture)) - at;
      for (std::size_t i = 0; i < hole.size(); ++i) {
        add(exact, transferThroughTriangle(kOrder, at * -1.0, centre, hole[i], hole[(i + 1) % hole.size()], 1));
      }
      Samples transfer;
      for (std::uint64_t seed = 1; seed <= 32; ++seed) {
        transfer.add(
            bakeSome(bowl.points, {p}, optionsOf(TransferKind::shadowed, kOrder, 1024, seed)).transfer.at(p, 0));
      }
      for (std::size_t i = 0; i < exact.size(); ++i) {
        INFO(degrees << " degrees, ring " << ring << ", coefficient " << i);
        // Koksma as for the sky, times the basis's largest value; the control variate's residual is of the same order.
        const double bias = 2 * std::sqrt((2 * sh::degreeOf(int(i)) + 1) / (4 * kPi)) / 1024;
        CHECK(std::abs(transfer.mean(i) - exact[i]) <= errorLimit(9 * 9, 32) * transfer.standardError(i) + bias);
      }
    }
  }
}

TEST_CASE("every reflection in a bowl adds the same vector everywhere", "[bowl]") {
  for (const double degrees : {30.0, 60.0, 90.0, 150.0}) {
    for (const float albedo : {0.5f, 0.9f, 0.99f}) {
      const Bowl bowl = makeBowl(degrees, albedo);
      const PointBake direct = bake(bowl, 0);
      const std::vector<double> mean = meanDirect(bowl, double(albedo));
      const double again = double(albedo) * bowl.f;
      for (const int bounces : {1, 8, BakeOptions::kBouncesAuto}) {
        const PointBake baked = bake(bowl, bounces);
        REQUIRE(baked.converged);
        double sum = 0;
        for (int k = 1; bounces < 0 ? k < 2000 : k <= bounces; ++k) sum += std::pow(again, k);

        // What the mesh may add, relative to the sum, with the longest edge e:
        // - facets lie e^2/8 inside the sphere, which counts once for the point that looks and once for what it sees;
        // - a transfer of degree l, linear over a facet, errs by e^2/8 of its second derivatives, l (l+1) at most;
        // - the polygonal hole lacks (2 pi / n)^2 / 6 of its area, which counts in the light let in and in f.
        // Repeated reflections sum these up as they sum the light: 1 / (1 - rho f) times.
        const double e2 = bowl.edge * bowl.edge / 8, area = std::pow(2 * kPi / kSectors, 2) / 6;
        const double relative = (e2 * (2 + (kOrder - 1) * kOrder) + area * (1 + (1 - bowl.f) / bowl.f)) / (1 - again);
        // Four times the greatest stated error, which is relative to the unshadowed transfer.
        const double stated = 4 * baked.maxError * sh::unshadowedNorm(kOrder) * double(albedo);
        const double solver = bounces < 0 ? 1e-3 * sh::unshadowedNorm(kOrder) : 0;
        std::vector<double> added(mean.size(), 0);
        double worst = 0;
        for (std::uint32_t p = 0; p < bowl.points.size(); ++p) {
          std::vector<double> difference(mean.size());
          for (std::size_t i = 0; i < mean.size(); ++i) {
            const double here = double(baked.transfer.at(p, 0)[i]) - double(direct.transfer.at(p, 0)[i]);
            added[i] += here / double(bowl.points.size());
            difference[i] = here - sum * mean[i];
          }
          worst = std::max(worst, norm(difference));
        }
        INFO(degrees << " degrees, albedo " << albedo << ", bounces " << bounces << ": worst " << worst << " of "
                     << sum * norm(mean) << ", bound " << relative * sum * norm(mean) + stated + solver);
        CHECK(worst <= relative * sum * norm(mean) + stated + solver);
        for (std::size_t i = 0; i < mean.size(); ++i) {
          INFO("coefficient " << i << ": " << added[i] << " against " << sum * mean[i]);
          CHECK(std::abs(added[i] - sum * mean[i]) <= relative * sum * norm(mean) + stated / 4 + solver);
        }
      }
    }
  }
}

TEST_CASE("what the mesh adds to a bowl's reflections falls with the square of its edges", "[bowl]") {
  // Halving the edges quarters the error of facets, interpolation and hole. Its next order falls sixteenfold, so that
  // the ratio may miss 4 by the relative size of the first error, at most a quarter here; the lattice adds its own.
  const double albedo = 0.9;
  double last = 0;
  for (const int rings : {6, 12, 24}) {
    const Bowl bowl = makeBowl(60, float(albedo), rings, 2 * rings);
    const std::vector<double> mean = meanDirect(bowl, albedo);
    const double again = albedo * bowl.f, sum = (again - std::pow(again, 9)) / (1 - again);
    Samples added;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      const PointBake direct = bake(bowl, 0, 256, seed), baked = bake(bowl, 8, 256, seed);
      std::vector<double> overPoints(mean.size(), 0);
      for (std::uint32_t p = 0; p < bowl.points.size(); ++p) {
        for (std::size_t i = 0; i < mean.size(); ++i) {
          const double here = double(baked.transfer.at(p, 0)[i]) - double(direct.transfer.at(p, 0)[i]);
          overPoints[i] += here / double(bowl.points.size());
        }
      }
      added.add(overPoints);
    }
    double squares = 0, lattice = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      squares += std::pow(added.mean(i) - sum * mean[i], 2);
      lattice += std::pow(errorLimit(mean.size(), 16) * added.standardError(i), 2);
    }
    const double error = std::sqrt(squares);
    INFO(rings << " rings: " << error << " after " << last << ", lattice " << std::sqrt(lattice));
    if (last > 0) CHECK(error <= last / 4 * 1.25 + std::sqrt(lattice));
    if (last > 0) CHECK(std::sqrt(lattice) < last);
    last = error;
  }
}

TEST_CASE("energy is conserved: white walls under constant light send out all of it", "[bowl]") {
  // With albedo 1 radiance 1 everywhere solves the equation on every mesh whose hits all meet fronts, and on the
  // lattice too: visible share + hidden share = 1. What is left is the solver's tolerance.
  for (const Mesh& mesh : {shapes::bowl(0.5, 12, 24, true), shapes::openCavity(3, 0.05, 25)}) {
    const LightingPoints points = pointsOf(mesh);
    BakeOptions options = optionsOf(TransferKind::interreflected, 1, 256);
    options.tolerance = 1e-3;
    const PointBake baked = bakeAll(points, options);
    REQUIRE(baked.converged);
    double sum = 0;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      sum += std::pow(std::sqrt(4 * kPi) * double(baked.transfer.at(p, 0)[0]) - 1, 2);
    }
    INFO(mesh.source);
    CHECK(std::sqrt(sum / double(points.size())) <= options.tolerance);
  }
}
