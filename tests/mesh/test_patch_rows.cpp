// Rows of points along both sides of lines.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/patch_rows.h"

using namespace shbake;

namespace {

const PointCounter kNoCount = [](std::size_t) {};
constexpr double kInfinity = std::numeric_limits<double>::infinity(), kOffset = 1e-3;

/// Rows beside lines on the square from (0, 0) to (4, 4).
PatchRows rowsOn(const std::vector<PatchLine>& lines, const std::function<double(Point2)>& wanted,
                 const std::vector<PatchObstacle>& obstacles = {}) {
  const std::vector<Point2> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  PatchLocator locator(square, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}, kNoCount);
  return rowsBeside(locator, lines, kOffset, obstacles, [&](std::uint32_t, Point2 p) { return wanted(p); });
}

double jointOf(const PatchRows& rows, std::size_t i) {
  const Point2 a = rows.points[rows.joints[i][0]].place, b = rows.points[rows.joints[i][1]].place;
  return std::hypot(b.x - a.x, b.y - a.y);
}

PatchLine circle(double radius, int sides) {
  PatchLine line{{}, true};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    line.places.push_back({2 + radius * std::cos(angle), 2 + radius * std::sin(angle)});
  }
  return line;
}

}  // namespace

TEST_CASE("rows stand at the offset on both sides, as closely as asked", "[refine]") {
  for (const double wanted : {2.0, 0.3, 0.05}) {
    const PatchRows rows = rowsOn({{{{1, 2}, {3, 2}}, false}}, [&](Point2) { return wanted; });
    std::size_t above = 0;
    for (const PatchPoint& p : rows.points) {
      CHECK(std::abs(std::abs(p.place.y - 2) - kOffset) < 1e-15);
      above += p.place.y > 2;
    }
    CHECK(2 * above == rows.points.size());
    CHECK(rows.joints.size() == rows.points.size() - 2);
    for (std::size_t i = 0; i < rows.joints.size(); ++i) {
      CHECK(jointOf(rows, i) <= kLongestEdge * wanted);
      if (wanted < 2) CHECK(jointOf(rows, i) > 0.69 * wanted);  // a half, shorter by an offset at the end of the line
    }
  }
}

TEST_CASE("rows around a closed line close, one inside and one outside", "[refine]") {
  const PatchRows rows = rowsOn({{{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, true}}, [](Point2) { return 9.0; });
  REQUIRE(rows.points.size() == 8);
  CHECK(rows.joints.size() == 8);
  std::size_t inside = 0;
  for (const PatchPoint& p : rows.points) {
    const double out = std::max(std::abs(p.place.x - 2), std::abs(p.place.y - 2)) - 1;
    CHECK(std::abs(std::abs(out) - kOffset) < 1e-15);
    inside += out < 0;
  }
  CHECK(inside == 4);
}

TEST_CASE("turns that are small beside the length wanted are passed over", "[refine]") {
  // The sagitta of a chord c of a circle of radius r is c^2 / 8r; a row of chords may stand out by 1/16 of the length.
  const auto stops = [](int sides, double wanted) {
    return rowsOn({circle(1, sides)}, [=](Point2) { return wanted; }).points.size() / 2;
  };
  CHECK(stops(24, 0.2) == 24);    // two sides at once would stand out by 0.034
  CHECK(stops(720, 0.1) <= 128);  // as halves of halves of the circle
  CHECK(double(stops(720, 0.1)) > 2 * std::numbers::pi / (0.1 * std::sqrt(2)));
  CHECK(stops(720, 1) <= 16);
  CHECK(stops(720, 1) >= 8);
  CHECK(rowsOn({circle(0.01, 12)}, [](Point2) { return 1.0; }).points.empty());
}

TEST_CASE("a line is followed as a whole where anything is wanted on it, else not at all", "[refine]") {
  const PatchLine line{{{0.5, 2}, {3.5, 2}}, false};
  CHECK(rowsOn({line}, [](Point2) { return kInfinity; }).points.empty());
  const PatchRows rows = rowsOn({line}, [](Point2 p) { return p.x < 1 ? 0.1 : kInfinity; });
  const auto x = [](const PatchPoint& p) { return p.place.x; };
  const auto [first, last] = std::minmax_element(rows.points.begin(), rows.points.end(),
                                                 [&](const auto& a, const auto& b) { return x(a) < x(b); });
  CHECK(x(*first) == Approx(0.5 + kOffset));
  CHECK(x(*last) == Approx(3.5 - kOffset));
  double longest = 0;
  for (std::size_t i = 0; i < rows.joints.size(); ++i) longest = std::max(longest, jointOf(rows, i));
  CHECK(longest > 0.3);
  CHECK(rows.points.size() < 40);
}

TEST_CASE("rows keep from obstacles, from each other, and inside the patch", "[refine]") {
  const PatchLine out{{{3, 2}, {5, 2}}, false}, edge{{{0, 4}, {4, 4}}, false};
  const PatchObstacle border{{0, 4}, {4, 4}, 0.25, 0};
  for (const PatchPoint& p : rowsOn({out}, [](Point2) { return 0.25; }).points) CHECK(p.place.x <= 4);
  CHECK(rowsOn({edge}, [](Point2) { return 0.25; }, {border}).points.empty());
  const PatchLine line{{{1, 2}, {3, 2}}, false};
  const auto wanted = [](Point2) { return 0.25; };
  CHECK(rowsOn({line, line}, wanted).points.size() == rowsOn({line}, wanted).points.size());
}
