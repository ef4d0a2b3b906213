// Sums over points of charts against the basis evaluated point by point.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "light/chart_sum.h"
#include "sh/basis.h"

using namespace shbake;
using std::numbers::pi;

namespace {

constexpr std::size_t kPoints = 150;  // more than two blocks, and no whole number of them

struct Point {
  double s, t;
  Vec3d color, mirrored;
};

std::vector<Point> randomPoints() {
  std::vector<Point> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const auto signedUnit = [&](std::uint64_t stream) { return 2 * hashUnit(stream, i) - 1; };
    points.push_back({signedUnit(1),
                      signedUnit(2),
                      {signedUnit(3), signedUnit(4), signedUnit(5)},
                      {signedUnit(6), signedUnit(7), signedUnit(8)}});
  }
  // The centre, where an angular map has no direction away from it, and a corner beyond its rim.
  points[0].s = points[0].t = 0;
  points[1].s = points[1].t = 1;
  return points;
}

/// The direct way: angles by the library's functions, the basis by sh::evaluate().
void addDirectly(MapLayout layout, const CubeFace& chart, int order, double s, double t, const Vec3d& color,
                 std::span<Vec3d> sum) {
  Vec3d direction;
  double density = 0;
  if (layout == MapLayout::angular) {
    const double r = std::hypot(s, t), slope = r > 0 ? std::sin(pi * r) / r : pi;
    direction = std::cos(pi * r) * chart.forward + slope * (s * chart.right + t * chart.up);
    density = pi * slope;
  } else {
    const Vec3d through = chart.forward + s * chart.right + t * chart.up;
    density = std::pow(dot(through, through), -1.5);
    direction = normalized(through);
  }
  std::vector<double> y(sum.size());
  sh::evaluate(order, direction, std::span(y));
  for (std::size_t i = 0; i < y.size(); ++i) sum[i] += density * y[i] * color;
}

/// What rounding can add up to: every term errs by (20 + l^2) 2^-52 of its bound at most, evaluate() and the recurrence
/// by (10 + l^2) of it and the solid angle by a few units.
double bound(MapLayout layout, int l) {
  const double largest = layout == MapLayout::angular ? pi * pi : 1;
  return 2 * kPoints * largest * (20 + l * l) * 0x1p-52 * 2 * std::sqrt((2 * l + 1) / (4 * pi));
}

}  // namespace

TEST_CASE("a chart's sum is that of its points, alone or with their mirror images", "[chart_sum]") {
  const std::vector<Point> points = randomPoints();
  for (const MapLayout layout : {MapLayout::angular, MapLayout::stripHorizontal, MapLayout::openexrCube}) {
    const int width = layout == MapLayout::stripHorizontal ? 48 : 8, height = layout == MapLayout::openexrCube ? 48 : 8;
    for (const CubeFace& chart : mapCharts(layout, width, height)) {
      for (const int order : {1, 2, 4, 7, 12}) {
        const auto count = static_cast<std::size_t>(sh::coefficientCount(order));
        std::vector<Vec3d> singles(count), pairs(count), direct(count), directPairs(count);
        ChartSum sum(layout, chart, order, singles), pairSum(layout, chart, order, pairs);
        for (const Point& p : points) {
          sum.add(p.s, p.t, p.color);
          pairSum.addPair(p.s, p.t, p.color, p.mirrored);
          addDirectly(layout, chart, order, p.s, p.t, p.color, direct);
          addDirectly(layout, chart, order, p.s, p.t, p.color, directPairs);
          addDirectly(layout, chart, order, -p.s, p.t, p.mirrored, directPairs);
        }
        sum.flush();
        pairSum.flush();
        for (std::size_t i = 0; i < count; ++i) {
          INFO(layoutName(layout) << " order " << order << " coefficient " << i);
          const double most = bound(layout, sh::degreeOf(static_cast<int>(i)));
          REQUIRE(length(singles[i] - direct[i]) < most);
          REQUIRE(length(pairs[i] - directPairs[i]) < most);
        }
      }
    }
  }
}

TEST_CASE("a sum goes on after it was flushed, and adds to what is there", "[chart_sum]") {
  const CubeFace chart = mapCharts(MapLayout::angular, 8, 8)[0];
  std::vector<Vec3d> once(4), twice(4);
  ChartSum sum(MapLayout::angular, chart, 2, once), again(MapLayout::angular, chart, 2, twice);
  sum.flush();
  CHECK(once == std::vector<Vec3d>(4));
  sum.add(0.25, 0.5, {1, 2, 3});
  sum.flush();
  for (int i = 0; i < 2; ++i) {
    again.add(0.25, 0.5, {1, 2, 3});
    again.flush();
  }
  for (std::size_t i = 0; i < 4; ++i) CHECK(twice[i] == 2.0 * once[i]);
}
