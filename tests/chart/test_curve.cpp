// Fronts, slopes and readings of curves that are known.
#include <catch2/catch.hpp>
#include <cmath>

#include "chart/sweep/curve.h"

using namespace shbake::chart;

namespace {

CurvePoint point(int rays, double cpu, double error) {
  CurvePoint p;
  p.rays = rays;
  p.cpu = cpu;
  p.error = error;
  return p;
}

/// error = rays^-0.75, cpu = rays / 1000.
std::vector<CurvePoint> powerLaw() {
  std::vector<CurvePoint> points;
  for (int rays = 16; rays <= 4096; rays *= 2) points.push_back(point(rays, rays / 1000.0, std::pow(rays, -0.75)));
  return points;
}

}  // namespace

TEST_CASE("the Pareto front holds what nothing beats in time and error at once", "[curve]") {
  const std::vector<CurvePoint> points{point(1, 1, 8), point(2, 2, 4), point(3, 3, 5), point(4, 4, 4),
                                       point(5, 8, 1), point(6, 1, 9), point(7, 8, 1)};
  // 3 is beaten by 2; 4 is as exact as 2 and slower; 6 as fast as 1 and less exact; 5 and 7 are equal.
  CHECK(paretoFront(points) == std::vector<bool>{true, true, false, false, true, false, true});
  CHECK(paretoFront({}).empty());
}

TEST_CASE("the excess over a front is the factor in both time and error", "[curve]") {
  const std::vector<CurvePoint> others{point(1, 1, 4), point(2, 2, 2)};
  CHECK(excessOverFront(point(3, 4, 3), others) == Approx(1.5));  // 2 is twice as fast and 1.5 times as exact
  CHECK(excessOverFront(point(3, 1, 2), others) == Approx(0.5));  // neither is as fast, or as exact, in both
  CHECK(excessOverFront(point(3, 1.5, 3), others) == Approx(0.75));
  CHECK(excessOverFront(point(3, 4, 1), std::vector{point(1, 1, 0)}) == Approx(4));
}

TEST_CASE("the slope of a power law is its exponent", "[curve]") {
  const auto points = powerLaw();
  CHECK(*slopeOf(points, 64, 4096) == Approx(-0.75).epsilon(1e-12));
  CHECK_FALSE(slopeOf(points, 64, 128));
  std::vector<CurvePoint> exact = points;
  for (CurvePoint& p : exact) p.error = 0;
  CHECK_FALSE(slopeOf(exact, 16, 4096));
}

TEST_CASE("between points a power law is read exactly, beyond them nothing", "[curve]") {
  const auto points = powerLaw();
  const double error = std::pow(1000.0, -0.75);
  const auto reading = effortFor(points, error);
  REQUIRE(reading);
  CHECK(reading->rays == Approx(1000).epsilon(1e-12));
  CHECK(reading->cpu == Approx(1).epsilon(1e-12));
  CHECK(effortFor(points, 1)->rays == 16);
  CHECK_FALSE(effortFor(points, 1e-6));
}

TEST_CASE("an error is reached, lies beyond what was measured, or is never reached", "[curve]") {
  const auto points = powerLaw();
  const Reach reached = reachOf(points, {}, 0.1), beyond = reachOf(points, 1e-7, 1e-6),
              never = reachOf(points, 1e-3, 1e-6);
  CHECK(reached.kind == Reach::Kind::reached);
  CHECK(reached.reading.cpu == effortFor(points, 0.1)->cpu);
  CHECK(beyond.kind == Reach::Kind::beyond);
  CHECK(beyond.reading.cpu == points.back().cpu);
  CHECK(never.kind == Reach::Kind::never);
  CHECK(reachOf({}, {}, 0.1).kind == Reach::Kind::never);
}
