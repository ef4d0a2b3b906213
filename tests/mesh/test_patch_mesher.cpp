// Plane triangulations: where a place lies, and what cannot be triangulated.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <utility>

#include "mesh/patch_mesher.h"

using namespace shbake;

namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

const PointCounter kNoCount = [](std::size_t) {};

double areaOf(const std::vector<Point2>& p, const std::vector<Triangle>& faces) {
  double sum = 0;
  for (const auto& [a, b, c] : faces) {
    const double area = ((p[b].x - p[a].x) * (p[c].y - p[a].y) - (p[b].y - p[a].y) * (p[c].x - p[a].x)) / 2;
    CHECK(area > 0);
    sum += area;
  }
  return sum;
}

const std::vector<Point2> kSquareInSquare{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};

}  // namespace

TEST_CASE("a patch with a hole, and one with a slit", "[refine]") {
  const auto ring = triangulatePatch(
      kSquareInSquare, Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 7}, {7, 6}, {6, 5}, {5, 4}}, {}, kNoCount);
  REQUIRE(ring);
  CHECK(ring->size() == 8);
  CHECK(areaOf(kSquareInSquare, *ring) == 8);
  const auto slit = triangulatePatch(
      kSquareInSquare, Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 4}, {5, 6}, {6, 5}, {6, 7}, {7, 6}}, {},
      kNoCount);
  REQUIRE(slit);
  CHECK(slit->size() == 10);
  CHECK(areaOf(kSquareInSquare, *slit) == 9);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : *slit) {
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [side, count] : sides) CHECK(count == 1);
  CHECK(sides.contains({4, 5}));
  CHECK(sides.contains({5, 4}));
}

TEST_CASE("borders that cross, open borders, points that coincide or lie outside are refused", "[refine]") {
  const std::vector<Point2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CHECK(triangulatePatch(square, Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {}, kNoCount));
  CHECK_FALSE(triangulatePatch(square, Pairs{{0, 2}, {2, 1}, {1, 3}, {3, 0}}, {}, kNoCount));
  CHECK_FALSE(triangulatePatch(square, Pairs{{0, 1}, {1, 2}, {2, 3}}, {}, kNoCount));
  CHECK_FALSE(triangulatePatch(square, Pairs{{1, 0}, {2, 1}, {3, 2}, {0, 3}}, {}, kNoCount));
  const std::vector<Point2> twice{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}},
      outside{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 2}}, onBorder{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}};
  for (const auto& points : {twice, outside, onBorder}) {
    CHECK_FALSE(triangulatePatch(points, Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {}, kNoCount));
  }
}

TEST_CASE("wishes become sides where they can", "[refine]") {
  const Pairs border{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto hasSide = [](const std::vector<Triangle>& faces, std::uint32_t a, std::uint32_t b) {
    return std::any_of(faces.begin(), faces.end(), [&](const Triangle& t) {
      return std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b);
    });
  };
  // A kite: Delaunay takes its shorter diagonal 4-5.
  const std::vector<Point2> kite{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {4, 4.5}, {5, 4.5}, {4.5, 7}, {4.5, 2}};
  const auto plain = triangulatePatch(kite, border, {}, kNoCount);
  REQUIRE(plain);
  CHECK(hasSide(*plain, 4, 5));
  const auto wished = triangulatePatch(kite, border, Pairs{{6, 7}, {4, 5}}, kNoCount);
  REQUIRE(wished);
  CHECK(hasSide(*wished, 6, 7));
  CHECK_FALSE(hasSide(*wished, 4, 5));
  CHECK(areaOf(kite, *wished) == 81);
  // Around a closed row, what is inside remains.
  const std::vector<Point2> ring{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 6}, {4, 5}};
  const auto closed = triangulatePatch(ring, border, Pairs{{4, 5}, {5, 6}, {6, 7}, {7, 4}}, kNoCount);
  REQUIRE(closed);
  CHECK(areaOf(ring, *closed) == 81);
  // Through a point.
  CHECK_FALSE(triangulatePatch(std::vector<Point2>{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {2, 2}, {4, 4}, {6, 6}}, border,
                               Pairs{{4, 6}}, kNoCount));
}

TEST_CASE("places are found in the faces they lie in", "[refine]") {
  const std::vector<Triangle> faces{{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}};
  PatchLocator patch(kSquareInSquare, faces, kNoCount);
  REQUIRE(patch.valid());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    Point2 centre;
    for (const std::uint32_t v : faces[f]) {
      centre = {centre.x + kSquareInSquare[v].x / 3, centre.y + kSquareInSquare[v].y / 3};
    }
    CHECK(patch.find(centre) == f);
  }
  for (const Point2& p : {Point2{1.5, 1.5}, Point2{0.2, 1.5}, Point2{-1, 0}, Point2{9, 9}}) {
    CHECK(patch.find(p) == PatchLocator::kNone);
  }
  CHECK(patch.find({1.5, 0}) == 0);
  CHECK(patch.find({1.5, 1}) == 1);
}

TEST_CASE("faces that overlap, or are wound the wrong way, are not valid", "[refine]") {
  const std::vector<Point2> p{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0.5}};
  CHECK(PatchLocator(p, std::vector<Triangle>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, kNoCount).valid());
  CHECK_FALSE(PatchLocator(p, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}, kNoCount).valid());
  CHECK_FALSE(PatchLocator(p, std::vector<Triangle>{{0, 1, 4}, {0, 1, 2}}, kNoCount).valid());
  CHECK_FALSE(PatchLocator(p, std::vector<Triangle>{{0, 4, 1}}, kNoCount).valid());
  CHECK_FALSE(PatchLocator(p, std::vector<Triangle>{{0, 1, 2}, {1, 3, 4}}, kNoCount).valid());
}
