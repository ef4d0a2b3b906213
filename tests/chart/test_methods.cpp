// The methods: exact where the answer is known, alike in expectation where it is not, and wrong where they are known to
// be.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "base/error.h"
#include "chart/sweep/direct.h"
#include "sh/basis.h"
#include "sh/irradiance.h"
#include "tests/chart/support.h"

using namespace shbake;
using namespace shbake::chart;
using namespace shbake::testing;

namespace {

/// The share of the sky that a transfer vector of order 1 stands for.
double seen(float t) {
  return static_cast<double>(t) / sh::unshadowedNorm(1);
}

/// Differences from `truth` of runs with different seeds.
std::vector<std::vector<double>> deviations(Bench& bench, const Method& method, int order, int rays, int runs,
                                            const std::vector<float>& truth) {
  std::vector<std::vector<double>> all;
  for (int run = 0; run < runs; ++run) {
    const Estimate e = bench.run(method, order, rays, static_cast<std::uint64_t>(run + 1));
    all.emplace_back();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      all.back().push_back(static_cast<double>(e.transfer[i]) - static_cast<double>(truth[i]));
    }
  }
  return all;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

TEST_CASE("methods have names of their own", "[methods]") {
  std::set<std::string> ids, titles;
  for (const Method& m : allMethods()) {
    CHECK(ids.insert(m.id).second);
    CHECK(titles.insert(m.title).second);
    CHECK(&methodNamed(m.id) == &m);
  }
  CHECK_THROWS_AS(methodNamed("none"), Error);
}

TEST_CASE("every direction of a convex body's points is free, whatever leaves out what they start from", "[methods]") {
  // Random and jittered directions of any kind have the open transfer as expectation; the first band of those that are
  // cosine-distributed is exact: all directions weigh alike in it. MeshLab's mean over faces errs by their tilt.
  Bench bench(shapes::icosphere(2));
  for (const Method& m : allMethods()) {
    if (m.group == MethodGroup::programs) continue;
    INFO(m.id);
    const Estimate e = bench.run(m, 1, 256, 1);
    REQUIRE(e.transfer.size() == bench.points.size());
    CHECK(e.rays == 256);
    for (const float t : e.transfer) CHECK(std::abs(seen(t) - 1) < 1e-6);
  }
}

TEST_CASE("shbake is exact on a convex body at every order", "[methods]") {
  Bench bench(shapes::icosphere(2));
  const Estimate e = bench.run(methodNamed("shbake"), 4, 16, 1);
  std::vector<double> open(16);
  for (std::size_t p = 0; p < bench.points.size(); ++p) {
    sh::unshadowedTransfer(4, normalized(Vec3d(bench.points.pointNormal[p])), 1, open);
    for (std::size_t k = 0; k < 16; ++k) CHECK(std::abs(static_cast<double>(e.transfer[p * 16 + k]) - open[k]) < 1e-6);
  }
}

TEST_CASE("consistent methods agree with a reference in expectation", "[methods]") {
  // The product of the deviations of two independent runs has the square of the common deviation as its expectation.
  // Batches of four runs give independent means over six products each: 16 of them, whose mean is off by its standard
  // error (Student, 15 degrees of freedom: beyond 5 of these with probability 2e-4).
  const int order = 3, rays = 256, batches = 16, size = 4;
  Bench bench(shapes::redFloorWhiteWall(4));
  const std::vector<float> truth =
      directTransfer(bench.points, bench.bed.exact(), bench.all, order, 1 << 17, 77, Parallel(1), bench.progress);
  for (const Method& m : allMethods()) {
    if (!m.consistent) continue;
    INFO(m.id);
    const auto runs = deviations(bench, m, order, rays, batches * size, truth);
    std::vector<double> shared;
    double single = 0;
    for (std::size_t b = 0; b < batches; ++b) {
      shared.push_back(0);
      for (std::size_t i = 0; i < size; ++i) {
        single += product(runs[b * size + i], runs[b * size + i]) / (batches * size);
        for (std::size_t j = 0; j < i; ++j) shared.back() += product(runs[b * size + i], runs[b * size + j]) / 6;
      }
    }
    double mean = 0, variance = 0;
    for (const double s : shared) mean += s / batches;
    for (const double s : shared) variance += (s - mean) * (s - mean) / (batches - 1) / batches;
    const std::string id = m.id;
    if (id == "cosine-random" || id == "cosine-jittered" || id == "cosine-sobol") {
      CHECK(std::abs(mean) < 5 * std::sqrt(variance));
    } else {
      // Rings of lattices and products stay where they are when they are turned about the normal, and err alike in all
      // runs; they cannot err by more than a run does altogether, and a wrong sum or a leak would be all of it.
      CHECK(mean < single / 2);
    }
    CHECK(single > 0);
  }
}

TEST_CASE("in a closed room nothing is seen, unless neighbours are left out", "[methods]") {
  Bench bench(shapes::boxRoom(2));
  const auto leak = [&](const char* id) {
    double sum = 0;
    for (const float t : bench.run(methodNamed(id), 1, 256, 1).transfer) sum += seen(t);
    return sum / static_cast<double>(bench.points.size());
  };
  for (const char* id : {"shbake", "fibonacci", "cosine-random", "gauss-product", "cosine-sobol", "meshlab"}) {
    INFO(id);
    CHECK(leak(id) == 0);
  }
  for (const char* id : {"neighbours-out", "near-epsilon", "normal-offset", "green", "libigl"}) {
    INFO(id);
    CHECK(leak(id) > 0.1);
  }
}

TEST_CASE("a lid close above a vertex is met by ours, and missed by offsets", "[methods]") {
  const double gap = 2.5e-5 * std::sqrt(32.0);
  Bench bench(shapes::lidAboveApex(gap));
  const std::uint32_t apex = bench.points.outputPoint[64];
  const auto share = [&](const char* id) {
    return seen(methodNamed(id).estimate(bench.bed, {{&apex, 1}, 1, 1024, 1}, bench.progress).transfer[0]);
  };
  CHECK(share("shbake") == 0);
  CHECK(share("neighbours-out") == 0);
  CHECK(share("normal-offset") > 0.9);
  CHECK(share("near-epsilon") > 0.9);
}

TEST_CASE("a method is a function of its seed, and times and counts are sound", "[methods]") {
  Bench bench(shapes::redFloorWhiteWall(4));
  for (const Method& m : allMethods()) {
    INFO(m.id);
    const Estimate one = bench.run(m, 3, 64, 5), same = bench.run(m, 3, 64, 5), other = bench.run(m, 3, 64, 6);
    CHECK(one.transfer == same.transfer);
    CHECK(one.transfer != other.transfer);
    CHECK(one.cpu > 0);
    CHECK(one.rays > 0);
    // MeshLab traces from faces, of which this mesh has more than points; no sphere has more than all rays above.
    CHECK(one.rays <= 64.0 * static_cast<double>(std::max(bench.points.faces.size(), bench.points.size())) /
                          static_cast<double>(bench.points.size()));
  }
}

TEST_CASE("methods stop when they are cancelled", "[methods]") {
  Bench bench(shapes::icosphere(3));
  for (const Method& m : allMethods()) {
    INFO(m.id);
    Progress stopped([](const ProgressState&) { return false; }, Progress::Duration(0));
    CHECK_THROWS_AS(m.estimate(bench.bed, {bench.all, 2, 16, 1}, stopped), Error);
  }
}
