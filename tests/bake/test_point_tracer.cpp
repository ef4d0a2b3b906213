// Point tracers: turns of the directions, chunks, hits on the fan.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "bake/point_tracer.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("the turn depends on seed and point alone and covers the circle", "[point_tracer]") {
  const LightingPoints points = pointsOf(shapes::icosphere(3));
  Progress progress;
  const RayScene scene(points, kInfinity, Parallel(1), progress);
  const DirectionSet set(16, 1);
  const PointTracer a(points, scene, set, 1, false), b(points, scene, set, 1, true), c(points, scene, set, 2, false);
  // Kolmogorov and Smirnov's statistic of n uniform numbers exceeds 2.2 / sqrt(n) with probability 1.2e-4.
  std::set<double> turns;
  int same = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    CHECK(a.spin(p) == b.spin(p));
    same += a.spin(p) == c.spin(p);
    turns.insert(a.spin(p) / (2 * kPi));
  }
  CHECK(same == 0);
  const double n = double(points.size());
  CHECK(turns.size() == points.size());
  double worst = 0, i = 0;
  for (const double turn : turns) {
    CHECK((turn >= 0 && turn < 1));
    worst = std::max({worst, std::abs(turn - i / n), std::abs(turn - (i + 1) / n)});
    ++i;
  }
  CHECK(worst < 2.2 / std::sqrt(n));
}

TEST_CASE("what a point sees does not depend on the points looked from before", "[point_tracer]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(0));
  Progress progress;
  const RayScene scene(points, kInfinity, Parallel(1), progress);
  const DirectionSet set(2048, 1);  // more groups than fit one call
  PointTracer forward(points, scene, set, 1, false), backward(points, scene, set, 1, false);
  std::vector<std::vector<std::uint16_t>> seen(points.size(), std::vector<std::uint16_t>(std::size_t(set.groups())));
  const auto n = std::uint32_t(points.size());
  for (std::uint32_t p = 0; p < n; p += 10) forward.look(p, seen[p]);
  std::vector<std::uint16_t> again(seen[0].size());
  for (std::uint32_t p = (n - 1) / 10 * 10;; p -= 10) {
    backward.look(p, again);
    REQUIRE(again == seen[p]);
    if (p == 0) break;
  }
}

TEST_CASE("several points see together what each sees alone", "[point_tracer]") {
  const LightingPoints points = pointsOf(shapes::chessPiece(0));
  Progress progress;
  const RayScene scene(points, kInfinity, Parallel(1), progress);
  // One group a point; some that do not fill a call; more than fit one.
  for (const int rays : {16, 5 * 16, 70 * 16}) {
    const DirectionSet set(rays, 1);
    PointTracer together(points, scene, set, 1, false), alone(points, scene, set, 1, false);
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t p = 0; p < points.size(); p += 3) chosen.push_back(p);
    const auto groups = std::size_t(set.groups());
    std::vector<std::uint16_t> skies(chosen.size() * groups), sky(groups);
    together.look(chosen, skies);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      alone.look(chosen[i], sky);
      REQUIRE(std::equal(sky.begin(), sky.end(), skies.begin() + std::ptrdiff_t(i * groups)));
    }
  }
}

TEST_CASE("a touching face that blocks is a hit at the position, on the other side of the crease", "[point_tracer]") {
  // A floor and a wall that share an edge: at the crease, half of what the floor sees is the wall at distance zero.
  const LightingPoints points = pointsOf(shapes::corner(2));
  Progress progress;
  const RayScene scene(points, kInfinity, Parallel(1), progress);
  const DirectionSet set(256, 1);
  PointTracer tracer(points, scene, set, 1, false);
  std::vector<std::uint16_t> sky(std::size_t(set.groups()));
  int atDistanceZero = 0;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    std::vector<Hit> hits;
    tracer.lookForHits(p, sky, hits);
    const std::uint32_t position = points.pointPosition[p];
    for (const Hit& h : hits) {
      const Triangle& face = points.faces[h.face];
      const auto corner = std::find(face.begin(), face.end(), position) - face.begin();
      if (corner == 3) continue;
      ++atDistanceZero;
      const std::uint16_t u = corner == 1 ? 65535 : 0, v = corner == 2 ? 65535 : 0;
      REQUIRE((h.u == u && h.v == v));
      const std::uint32_t other = points.facePoints[h.face][std::size_t(corner)];
      REQUIRE(points.pointPosition[other] == position);
      REQUIRE(dot(points.pointNormal[other], points.pointNormal[p]) < 0.1f);
    }
  }
  CHECK(atDistanceZero > 0);
}

TEST_CASE("hits tell where they are", "[point_tracer]") {
  // Two sheets 1 apart: a hit at direction d lies at the origin + d / d.z. Weights are quantised to 1/65535.
  const LightingPoints points = pointsOf(shapes::parallelSheets(1, 2));
  Progress progress;
  const RayScene scene(points, kInfinity, Parallel(1), progress);
  const DirectionSet set(256, 1);
  PointTracer tracer(points, scene, set, 4, false);
  std::vector<std::uint16_t> sky(std::size_t(set.groups()));
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    std::vector<Hit> hits;
    tracer.lookForHits(p, sky, hits);
    const std::vector<Vec3d> directions = directionsOf(points, p, set, 4);
    std::size_t next = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if ((sky[i / 16] >> (i % 16) & 1) != 0) continue;
      REQUIRE(next < hits.size());
      const Hit& h = hits[next++];
      const double u = h.u / 65535.0, v = h.v / 65535.0;
      Vec3d at;
      const double weight[] = {1 - u - v, u, v};
      for (std::size_t k = 0; k < 3; ++k) at += Vec3d(points.positions[points.faces[h.face][k]]) * weight[k];
      const Vec3d origin(points.positions[points.pointPosition[p]]);
      const Vec3d expected = origin + directions[i] * (std::abs(at.z - origin.z) / std::abs(directions[i].z));
      // Half a quantum of both weights on edges of sqrt(2), and float barycentrics.
      REQUIRE(length(at - expected) < 2 * std::sqrt(2.0) * 0.5 / 65535 + 1e-5);
    }
    REQUIRE(next == hits.size());
  }
}
