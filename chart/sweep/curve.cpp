// Fronts, slopes and readings of curves.
#include "chart/sweep/curve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shbake::chart {
namespace {

/// Standard errors that chance does not reach: once in 740 times where they are normally distributed.
constexpr double kBeyondChance = 3;

}  // namespace

std::vector<bool> paretoFront(std::span<const CurvePoint> points) {
  std::vector<bool> front;
  for (const CurvePoint& p : points) {
    front.push_back(std::none_of(points.begin(), points.end(), [&](const CurvePoint& q) {
      return q.cpu <= p.cpu && q.error <= p.error && (q.cpu < p.cpu || q.error < p.error);
    }));
  }
  return front;
}

LeastTime leastTime(std::span<const double> times) {
  const double least = *std::min_element(times.begin(), times.end());
  if (times.size() < 2) return {least, 0};
  const auto n = static_cast<double>(times.size());
  const double mean = std::accumulate(times.begin(), times.end(), 0.0) / n;
  return {least, (mean - least) / (n - 1) / least};
}

Excess excessOverFront(const CurvePoint& point, std::span<const CurvePoint> others) {
  Excess excess;
  for (const CurvePoint& q : others) {
    const double speed = point.cpu / q.cpu;
    const double accuracy = q.error > 0 ? point.error / q.error : point.error > 0 ? INFINITY : 1;
    excess.factor = std::max(excess.factor, std::min(speed, accuracy));
    excess.beyondChance |= std::log(speed) > kBeyondChance * std::hypot(point.cpuSpread, q.cpuSpread) &&
                           std::log(accuracy) > kBeyondChance * std::hypot(point.errorSpread, q.errorSpread);
  }
  return excess;
}

std::optional<double> slopeOf(std::span<const CurvePoint> points, int least, int most) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const CurvePoint& p : points) {
    if (p.rays < least || p.rays > most || p.error <= 0) continue;
    const double u = std::log(p.rays), v = std::log(p.error);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  if (n < 3) return {};
  return (n * xy - x * y) / (n * xx - x * x);
}

std::optional<Reading> effortFor(std::span<const CurvePoint> points, double error) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CurvePoint& p = points[i];
    if (p.error > error) continue;
    if (i == 0 || p.error <= 0) return Reading{double(p.rays), p.cpu};
    const CurvePoint& before = points[i - 1];
    const double t = std::log(before.error / error) / std::log(before.error / p.error);
    return Reading{before.rays * std::pow(double(p.rays) / before.rays, t),
                   before.cpu * std::pow(p.cpu / before.cpu, t)};
  }
  return {};
}

Reach reachOf(std::span<const CurvePoint> points, std::optional<double> systematic, double error) {
  if (const auto effort = effortFor(points, error)) return {Reach::Kind::reached, *effort};
  if (points.empty() || (systematic && *systematic >= error)) return {};
  return {Reach::Kind::beyond, {double(points.back().rays), points.back().cpu}};
}

}  // namespace shbake::chart
