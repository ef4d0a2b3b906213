// Medians of CPU time, taken by turns.
#include "equal_time.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bake/direction_set.h"
#include "chart/methods/cpu_clock.h"

namespace shbake::bench {
namespace {

constexpr double kTurnsSeconds = 2;

double secondsOf(const std::function<void()>& run) {
  const double start = chart::cpuSeconds();
  run();
  return chart::cpuSeconds() - start;
}

}  // namespace

EqualTime::EqualTime(std::function<void(int)> points, int rays) : points_(std::move(points)), rays_(rays) {
  const Seconds s = inTurns([&] { points_(3 * rays_); });
  shareOfRays_ = std::clamp((s.run / s.points - 1) / 2, 0.01, 1.0);
}

EqualTime::Cost EqualTime::of(const std::function<void()>& run) const {
  const Seconds s = inTurns(run);
  return {s.run, std::max(1.0, rays_ * (1 + (s.run / s.points - 1) / shareOfRays_))};
}

EqualTime::Seconds EqualTime::inTurns(const std::function<void()>& run) const {
  std::vector<double> ofRun, ofPoints;
  const double start = chart::cpuSeconds();
  do {
    ofPoints.push_back(secondsOf([&] { points_(rays_); }));
    ofRun.push_back(secondsOf(run));
  } while (chart::cpuSeconds() - start < kTurnsSeconds);
  return {chart::median(ofRun), chart::median(ofPoints)};
}

double errorBetweenGroups(double rays, const std::function<double(int)>& errorOf) {
  constexpr int kGroup = DirectionSet::kGroup;
  constexpr double kMostRays = 1 << 20;
  rays = std::clamp(rays, double(kGroup), kMostRays);
  const int fewer = static_cast<int>(rays) / kGroup * kGroup;
  const double before = errorOf(fewer), after = errorOf(fewer + kGroup);
  return before * std::pow(after / before, std::log(rays / fewer) / std::log(1 + double(kGroup) / fewer));
}

}  // namespace shbake::bench
