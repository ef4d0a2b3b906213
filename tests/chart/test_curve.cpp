// Fronts, slopes and readings of curves that are known.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/hash.h"
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
  CHECK(excessOverFront(point(3, 4, 3), others).factor == Approx(1.5));  // 2 is twice as fast and 1.5 times as exact
  CHECK(excessOverFront(point(3, 1, 2), others).factor == Approx(0.5));  // neither is as fast, or as exact, in both
  CHECK(excessOverFront(point(3, 1.5, 3), others).factor == Approx(0.75));
  CHECK(excessOverFront(point(3, 4, 1), std::vector{point(1, 1, 0)}).factor == Approx(4));
}

TEST_CASE("a lead over a point is beyond chance where time and error both lead by three standard errors", "[curve]") {
  CurvePoint ours = point(3, 1.1, 1.2), better = point(4, 1, 1);
  CHECK(excessOverFront(ours, {&better, 1}).beyondChance);
  ours.cpuSpread = 0.04;  // log 1.1 = 0.0953 is 2.4 of them
  CHECK(excessOverFront(ours, {&better, 1}).factor == Approx(1.1));
  CHECK_FALSE(excessOverFront(ours, {&better, 1}).beyondChance);
  ours.cpuSpread = better.cpuSpread = 0.02;  // log 1.1 is 3.4 of both together
  CHECK(excessOverFront(ours, {&better, 1}).beyondChance);
  better.errorSpread = 0.1;  // log 1.2 = 0.182 is 1.8 of them
  CHECK_FALSE(excessOverFront(ours, {&better, 1}).beyondChance);
}

TEST_CASE("the least of delayed times is as uncertain as stated", "[curve]") {
  CHECK(leastTime(std::vector{2.0}).cpu == 2);
  CHECK(leastTime(std::vector{2.0}).spread == 0);
  // Times of 1 with exponential delays of mean 0.2, four at a time: the least is late by 0.05 with a standard deviation
  // of 0.05. The stated error has the expectation 0.05 too, and here a variance of 0.05^2 / 3: the mean of 4000 of them
  // is off by less than four standard errors.
  constexpr int kSets = 4000;
  double stated = 0, late = 0;
  for (std::uint64_t set = 0; set < kSets; ++set) {
    std::vector<double> times;
    for (std::uint64_t run = 0; run < 4; ++run) times.push_back(1 - 0.2 * std::log1p(-shbake::hashUnit(run, set)));
    const LeastTime least = leastTime(times);
    stated += least.spread * least.cpu / kSets;
    late += (least.cpu - 1) / kSets;
  }
  CHECK(std::abs(late - 0.05) < 4 * 0.05 / std::sqrt(kSets));
  CHECK(std::abs(stated - 0.05) < 4 * 0.05 / std::sqrt(3.0 * kSets));
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
