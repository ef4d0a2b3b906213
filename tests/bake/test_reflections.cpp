// Reflections: gathering against explicit sums, memory budgets, threads, and the symmetry of who sees whom.
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "bake/direct_transfer.h"
#include "bake/reflections.h"
#include "bake/stated_error.h"
#include "bake/support.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max() / 2;

/// A traced scene, and a copy of the hits of every point.
class Traced {
 public:
  Traced(const LightingPoints& points, int rays, std::uint64_t seed, std::size_t memory = kUnlimited, int threads = 1,
         bool twoSided = false)
      : points_(points),
        parallel_(threads),
        scene_(points, std::numeric_limits<float>::infinity(), parallel_, progress_),
        set_(rays, 2),
        reflections_(points, scene_, set_, seed, twoSided, memory, parallel_),
        hits(points.size()),
        sky(points.size()) {
    std::vector<std::atomic<int>> visits(points.size());
    reflections_.trace(
        [&](std::uint32_t p, std::span<const std::uint16_t> masks, std::span<const Hit> found, int) {
          hits[p].assign(found.begin(), found.end());
          sky[p].assign(masks.begin(), masks.end());
          ++visits[p];
        },
        progress_);
    for (const auto& v : visits) REQUIRE(v == 1);
  }

  std::vector<float> gather(const std::vector<float>& in, std::size_t columns) {
    std::vector<float> out(points_.size() * columns, -1.0f);
    reflections_.gather(in.data(), out.data(), columns, progress_);
    return out;
  }

  void forget(std::size_t memory) { reflections_.forget(memory); }
  const Reflections& reflections() const { return reflections_; }
  int rays() const { return set_.size(); }

 private:
  const LightingPoints& points_;
  Parallel parallel_;
  Progress progress_;
  RayScene scene_;
  DirectionSet set_;
  Reflections reflections_;

 public:
  std::vector<std::vector<Hit>> hits;
  std::vector<std::vector<std::uint16_t>> sky;
};

std::vector<float> randomValues(std::size_t size, std::uint64_t seed) {
  std::vector<float> v(size);
  for (std::size_t i = 0; i < size; ++i) v[i] = float(hashUnit(seed, i) - 0.3);
  return v;
}

}  // namespace

TEST_CASE("gathering is the sum over the hits of what the faces send, interpolated", "[reflections]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(3));
  for (const int rays : {64, 2048}) {
    Traced traced(points, rays, 3);
    for (const std::size_t columns : {4u, 8u, 12u, 16u, 20u, 36u}) {
      if (rays > 64 && columns != 12) continue;
      const std::vector<float> in = randomValues(points.size() * columns, columns), out = traced.gather(in, columns);
      for (std::size_t p = 0; p < points.size(); ++p) {
        for (std::size_t k = 0; k < columns; ++k) {
          double sum = 0;
          for (const Hit& h : traced.hits[p]) {
            const Triangle& t = points.facePoints[h.face];
            const double u = h.u / 65535.0, v = h.v / 65535.0;
            sum += (1 - u - v) * double(in[t[0] * columns + k]) + u * double(in[t[1] * columns + k]) +
                   v * double(in[t[2] * columns + k]);
          }
          // Terms of at most 1 are rounded 4 times each, and their sum once a term, over at most 1024 of them.
          const double bound = kHalfUlp * double(traced.hits[p].size()) * (4 + 1024.0 / 2) / traced.rays() + kHalfUlp;
          REQUIRE(std::abs(double(out[p * columns + k]) - sum / traced.rays()) <= bound);
        }
      }
    }
  }
}

TEST_CASE("every direction is sky, a hit on a front, or absorbed by a back", "[reflections]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(3));
  Traced one(points, 256, 1), both(points, 256, 1, kUnlimited, 1, true);
  bool absorbed = false;
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    int visible = 0;
    for (const std::uint16_t mask : one.sky[p]) visible += __builtin_popcount(mask);
    CHECK(one.sky[p] == both.sky[p]);
    CHECK(int(both.hits[p].size()) + visible == one.rays());
    CHECK(one.hits[p].size() <= both.hits[p].size());
    absorbed |= one.hits[p].size() < both.hits[p].size();
  }
  CHECK(absorbed);  // the room's walls are single sheets: the outside of a corner sees backs
}

TEST_CASE("constant light gathers to the share that is hit", "[reflections]") {
  const LightingPoints points = pointsOf(shapes::openCavity(2, 0.1, 30));
  Traced traced(points, 256, 1);
  const std::vector<float> out = traced.gather(std::vector<float>(points.size() * 4, 1.0f), 4);
  for (std::size_t p = 0; p < points.size(); ++p) {
    // Weights 1 - u - v, u, v sum to 1 but for three roundings a hit.
    const double share = double(traced.hits[p].size()) / traced.rays();
    CHECK(std::abs(double(out[4 * p]) - share) <= share * (3 + 256) * kHalfUlp + kHalfUlp);
  }
}

TEST_CASE("a memory budget changes what is stored, not what is gathered", "[reflections]") {
  const LightingPoints points = pointsOf(shapes::city(2, 2, 4));
  Traced all(points, 256, 5);
  CHECK(all.reflections().forgottenPoints() == 0);
  std::size_t bytes = 4 * points.size();
  for (const auto& h : all.hits) bytes += h.size() * sizeof(Hit);
  CHECK(all.reflections().storedBytes() == bytes);

  const std::vector<float> in = randomValues(points.size() * 8, 1), expected = all.gather(in, 8);
  for (const std::size_t budget : {std::size_t(0), bytes / 2}) {
    Traced some(points, 256, 5, budget);
    CHECK(some.reflections().storedBytes() <= budget);
    CHECK(some.reflections().forgottenPoints() > 0);
    if (budget == 0) CHECK(some.reflections().forgottenPoints() == points.size());
    if (budget > 0) CHECK(some.reflections().forgottenPoints() < points.size());
    CHECK(some.reflections().hitBytes() == bytes);
    CHECK(sameBits(some.gather(in, 8), expected));
  }
  all.forget(bytes / 3);
  CHECK(all.reflections().storedBytes() <= bytes / 3);
  CHECK(all.reflections().storedBytes() > 0);
  CHECK(all.reflections().hitBytes() == bytes);
  CHECK(all.reflections().forgottenPoints() > 0);
  CHECK(all.reflections().forgottenPoints() < points.size());
  CHECK(sameBits(all.gather(in, 8), expected));
}

TEST_CASE("hits and sums are the same on any number of threads", "[reflections]") {
  const LightingPoints points = pointsOf(shapes::city(2, 2, 4));
  const std::vector<float> in = randomValues(points.size() * 4, 2);
  std::vector<std::vector<Hit>> hits;
  std::vector<float> expected;
  {
    // Gone before the next: Embree lets no loop of the program run on more threads than any of its devices has.
    Traced one(points, 64, 5);
    hits = one.hits;
    expected = one.gather(in, 4);
  }
  for (const int threads : {2, 3}) {
    Traced more(points, 64, 5, kUnlimited, threads);
    for (std::size_t p = 0; p < points.size(); ++p) {
      REQUIRE(more.hits[p].size() == hits[p].size());
      for (std::size_t h = 0; h < hits[p].size(); ++h) {
        const Hit &a = hits[p][h], &b = more.hits[p][h];
        REQUIRE((a.face == b.face && a.u == b.u && a.v == b.v));
      }
    }
    CHECK(sameBits(more.gather(in, 4), expected));
  }
}

TEST_CASE("light goes both ways alike: stored hits are reciprocal", "[reflections]") {
  // The light that octant i of a closed surface receives from octant j, weighted by area, equals the reverse: areas
  // times form factors are symmetric. Over seeds this holds within standard errors and the mesh's own error: sums over
  // vertices weighted by a third of the faces around them, as integrals of a kernel 1 / 4 pi that facets of edge e
  // change by e^2/8 twice.
  const LightingPoints points = pointsOf(shapes::inwardSphere(3));
  const std::vector<double> areas = pointAreas(points);
  std::vector<int> octant(points.size());
  double total = 0, edge = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3f at = points.positions[points.pointPosition[p]];
    // Split beside the axes, so that no ring of vertices lies on a border.
    octant[p] = (at.x > 0.013f ? 1 : 0) + (at.y > 0.017f ? 2 : 0) + (at.z > 0.011f ? 4 : 0);
    total += areas[p];
  }
  for (const Triangle& t : points.faces) {
    edge = std::max(edge, double(length(points.positions[t[0]] - points.positions[t[1]])));
  }
  Samples exchange;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    Traced traced(points, 64, seed);
    std::vector<double> flow(64, 0);
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (const Hit& h : traced.hits[p]) {
        const Triangle& t = points.facePoints[h.face];
        const double u = h.u / 65535.0, v = h.v / 65535.0, weight[] = {1 - u - v, u, v};
        for (std::size_t k = 0; k < 3; ++k) {
          flow[std::size_t(octant[p] * 8 + octant[t[k]])] += areas[p] * weight[k] / traced.rays() / total;
        }
      }
    }
    std::vector<double> difference(64);
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = 0; j < 8; ++j) difference[8 * i + j] = flow[8 * i + j] - flow[8 * j + i];
    }
    exchange.add(difference);
  }
  for (std::size_t i = 0; i < 64; ++i) {
    // A pair of octants exchanges 1/64 of the light.
    const double mesh = 2 * edge * edge / 8 / 64;
    INFO("octants " << i / 8 << " and " << i % 8);
    CHECK(std::abs(exchange.mean(i)) <= errorLimit(64, 16) * exchange.standardError(i) + mesh);
  }
}

TEST_CASE("a doubled wall shows the side that faces the point", "[reflections]") {
  // Above a floor hangs a sheet whose faces come twice, once for each side. Its underside is what the floor must meet.
  for (const bool undersideFirst : {true, false}) {
    Mesh sheet = shapes::grid({-2, -2, 1}, {4, 0, 0}, {0, 4, 0});
    const std::vector<Triangle> up = sheet.triangles;
    sheet.triangles.clear();
    for (const bool under : {undersideFirst, !undersideFirst}) {
      for (const Triangle& t : up) sheet.triangles.push_back(under ? Triangle{t[0], t[2], t[1]} : t);
    }
    const LightingPoints points = pointsOf(shapes::merged(shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2), sheet),
                                           {1, 1, 1}, {.normals = NormalSource::flat});
    Traced traced(points, 256, 1);
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (points.positions[points.pointPosition[p]].z > 0) continue;
      int blocked = traced.rays();
      for (const std::uint16_t mask : traced.sky[p]) blocked -= __builtin_popcount(mask);
      REQUIRE(blocked > 0);
      INFO("underside first " << undersideFirst);
      CHECK(int(traced.hits[p].size()) == blocked);
      for (const Hit& h : traced.hits[p]) {
        for (const std::uint32_t q : points.facePoints[h.face]) REQUIRE(points.pointNormal[q].z == -1);
      }
    }
  }
}
