// Bakes as a whole: channels, kinds of transfer, nested orders, reflecting backs, wanted points, options, cancelling.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>

#include "bake/support.h"
#include "base/error.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

BakeOptions reflected(int order, int rays, int bounces) {
  BakeOptions options = optionsOf(TransferKind::interreflected, order, rays);
  options.bounces = bounces;
  return options;
}

ErrorKind kindOf(const BakeOptions& options) {
  const LightingPoints points = pointsOf(shapes::tetrahedron());
  try {
    bakeAll(points, options);
  } catch (const Error& error) {
    return error.kind();
  }
  FAIL("no Error was thrown");
  return ErrorKind::work;
}

}  // namespace

TEST_CASE("grey albedo makes one channel, coloured albedo three", "[baker]") {
  const Mesh mesh = shapes::corner(2);
  CHECK(bakeAll(pointsOf(mesh, {0.5f, 0.5f, 0.5f}), reflected(2, 16, 1)).transfer.channels == 1);
  CHECK(bakeAll(pointsOf(mesh, {0.5f, 0.5f, 0.4f}), reflected(2, 16, 1)).transfer.channels == 3);
}

TEST_CASE("what is not baked asks for channels only where it reflects", "[baker]") {
  LightingPoints points = pointsOf(shapes::corner(2), {0.5f, 0.5f, 0.5f});
  points.pointAlbedo[1] = {0.5f, 0.2f, 0.2f};
  BakeOptions options = optionsOf(TransferKind::shadowed, 2, 16);
  CHECK(bakeSome(points, {0}, options).transfer.channels == 1);
  CHECK(bakeSome(points, {1}, options).transfer.channels == 3);
  options.kind = TransferKind::interreflected;
  CHECK(bakeSome(points, {0}, options).transfer.channels == 3);
  options.bounces = 0;
  CHECK(bakeSome(points, {0}, options).transfer.channels == 1);
}

TEST_CASE("a coloured bake equals three grey ones", "[baker]") {
  const Mesh mesh = shapes::corner(3);
  for (const int bounces : {0, 3, BakeOptions::kBouncesAuto}) {
    const PointBake colored = bakeAll(pointsOf(mesh, {0.9f, 0.5f, 0.1f}), reflected(3, 64, bounces));
    const float albedo[] = {0.9f, 0.5f, 0.1f};
    for (int c = 0; c < 3; ++c) {
      const PointBake grey = bakeAll(pointsOf(mesh, {albedo[c], albedo[c], albedo[c]}), reflected(3, 64, bounces));
      for (std::size_t p = 0; p < grey.transfer.size(); ++p) {
        const auto a = colored.transfer.at(p, c), b = grey.transfer.at(p, 0);
        // The same arithmetic on the same numbers.
        REQUIRE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
      }
    }
  }
}

TEST_CASE("black surfaces reflect nothing", "[baker]") {
  const Mesh mesh = shapes::cornellRoom(2);
  Mesh black = mesh;
  black.faceColors.assign(mesh.triangles.size(), Rgb());
  const PointBake none = bakeAll(pointsOf(black), reflected(3, 64, BakeOptions::kBouncesAuto));
  for (const float value : none.transfer.coefficients) REQUIRE(value == 0);

  // A black blocker: nothing but the direct light is left on the white floor below it.
  Mesh floor = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2);
  Mesh scene = shapes::merged(shapes::colored(floor, {1, 1, 1}),
                              shapes::colored(shapes::flipped(shapes::grid({-1, -1, 1}, {2, 0, 0}, {0, 2, 0})), {}));
  const LightingPoints points = pointsOf(scene);
  CHECK(bakeAll(points, reflected(3, 64, 5)).transfer.coefficients ==
        bakeAll(points, optionsOf(TransferKind::shadowed, 3, 64)).transfer.coefficients);
}

TEST_CASE("without bounces interreflected transfer is the shadowed one", "[baker]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(2));
  CHECK(sameBits(bakeAll(points, reflected(3, 64, 0)).transfer.coefficients,
                 bakeAll(points, optionsOf(TransferKind::shadowed, 3, 64)).transfer.coefficients));
}

TEST_CASE("albedo scales direct transfer", "[baker]") {
  const Mesh mesh = shapes::city(1, 1, 2);
  const PointBake white = bakeAll(pointsOf(mesh), optionsOf(TransferKind::shadowed, 3, 64));
  const PointBake half = bakeAll(pointsOf(mesh, {0.5f, 0.5f, 0.5f}), optionsOf(TransferKind::shadowed, 3, 64));
  for (std::size_t i = 0; i < white.transfer.coefficients.size(); ++i) {
    REQUIRE(half.transfer.coefficients[i] == 0.5f * white.transfer.coefficients[i]);
  }
}

TEST_CASE("backs absorb, or reflect what their fronts send where both sides do", "[baker]") {
  // A sheet above a floor, its front up and open to the sky: its transfer t is the closed form. Looking up, the floor
  // meets backs with the share h: nothing comes from them, or h t on top of the direct light.
  const Mesh floor = shapes::grid({-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0});
  const LightingPoints points =
      pointsOf(shapes::merged(floor, shapes::grid({-2, -2, 1}, {4, 0, 0}, {0, 4, 0})), {0.5f, 0.5f, 0.5f});
  BakeOptions options = reflected(3, 1024, 1);
  const PointBake direct = bakeAll(points, optionsOf(TransferKind::shadowed, 3, 1024));
  const PointBake absorbing = bakeAll(points, options);
  options.twoSided = true;
  const PointBake reflecting = bakeAll(points, options);
  CHECK(sameBits(absorbing.transfer.coefficients, direct.transfer.coefficients));
  const std::uint32_t sheet = pointOfVertex(points, 4);
  for (std::uint32_t v = 0; v < 4; ++v) {
    const std::uint32_t p = pointOfVertex(points, v);
    const double hidden = 1 - double(direct.transfer.visibility[p]);
    CHECK(hidden > 0.5);
    for (std::size_t i = 0; i < 9; ++i) {
      const double added = double(reflecting.transfer.at(p, 0)[i]) - double(direct.transfer.at(p, 0)[i]);
      // 1024 float additions of terms below 1/2, in random rounding at most their number times half an ulp.
      CHECK(std::abs(added - 0.5 * hidden * double(direct.transfer.at(sheet, 0)[i])) < 1024 * kHalfUlp);
    }
  }
}

TEST_CASE("an order's coefficients begin every higher order's", "[baker]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(2));
  const PointBake most = bakeAll(points, reflected(8, 64, 2));
  for (int order = 1; order < 8; ++order) {
    const PointBake few = bakeAll(points, reflected(order, 64, 2));
    REQUIRE(few.transfer.channels == most.transfer.channels);
    double worst = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (int c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < std::size_t(order * order); ++i) {
          worst = std::max(worst, std::abs(double(few.transfer.at(p, c)[i]) - double(most.transfer.at(p, c)[i])));
        }
      }
    }
    INFO("order " << order);
    // The same sums; rotations of one band may be vectorised differently, to 1e-15, before they are rounded to float.
    CHECK(worst <= kHalfUlp);
  }
  // Above order 8 the table is summed in double: float sums of up to 4 groups of 9 additions differ from it.
  const PointBake wide = bakeAll(points, reflected(9, 64, 0)), narrow = bakeAll(points, reflected(8, 64, 0));
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t i = 0; i < 64; ++i) {
      REQUIRE(std::abs(double(wide.transfer.at(p, 0)[i]) - double(narrow.transfer.at(p, 0)[i])) < 36 * kHalfUlp);
    }
  }
}

TEST_CASE("rounding up the rays is told, and points that are not wanted cost nothing", "[baker]") {
  const LightingPoints points = pointsOf(shapes::city(1, 1, 2));
  const PointBake all = bakeAll(points, optionsOf(TransferKind::shadowed, 3, 100));
  CHECK(all.rays == 112);
  const std::vector<std::uint32_t> wanted{3, 17};
  const PointBake some = bakeSome(points, wanted, optionsOf(TransferKind::shadowed, 3, 100));
  for (const std::uint32_t p : wanted) {
    const auto a = all.transfer.at(p, 0), b = some.transfer.at(p, 0);
    CHECK(std::equal(a.begin(), a.end(), b.begin()));
  }
  for (const float value : some.transfer.at(0, 0)) CHECK(value == 0);
  // The error figures count wanted points only.
  CHECK(some.maxError == double(std::max(some.transfer.error[3], some.transfer.error[17])));
}

TEST_CASE("memory never changes a result, whatever is stored or solved at once", "[baker]") {
  const LightingPoints points = pointsOf(shapes::cornellRoom(3));
  for (const int bounces : {3, BakeOptions::kBouncesAuto}) {
    BakeOptions options = reflected(4, 64, bounces);
    options.memory = std::size_t(1) << 30;
    const PointBake rich = bakeAll(points, options);
    CHECK(rich.retracedPoints == 0);
    CHECK(rich.storedBytes > 0);
    options.memory = rich.wantedMemory;
    const PointBake enough = bakeAll(points, options);
    CHECK(enough.retracedPoints == 0);
    CHECK(sameBits(enough.transfer.coefficients, rich.transfer.coefficients));
    for (const std::size_t memory : {std::size_t(1), rich.storedBytes, rich.wantedMemory - 1}) {
      options.memory = memory;
      const PointBake poor = bakeAll(points, options);
      INFO("bounces " << bounces << ", memory " << memory);
      CHECK(sameBits(poor.transfer.coefficients, rich.transfer.coefficients));
      CHECK(sameBits(poor.transfer.error, rich.transfer.error));
      CHECK(poor.bounces == rich.bounces);
      CHECK(poor.retracedPoints > 0);
      if (memory == 1) CHECK(poor.retracedPoints == points.size());
    }
  }
}

TEST_CASE("summing to the tolerance agrees with summing many reflections", "[baker]") {
  Mesh mesh = shapes::bowl(0.6, 10, 20, true);
  const LightingPoints points = pointsOf(mesh, {0.9f, 0.9f, 0.9f});
  const PointBake many = bakeAll(points, reflected(3, 64, 400));  // (0.9 * 0.91)^400 is nothing
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    BakeOptions options = reflected(3, 64, BakeOptions::kBouncesAuto);
    options.tolerance = tolerance;
    const PointBake solved = bakeAll(points, options);
    CHECK(solved.converged);
    CHECK(solved.bounces < 20);
    // Relative to the unshadowed transfer of the same albedo, as the tolerance is.
    const PointBake open = bakeAll(points, optionsOf(TransferKind::unshadowed, 3, 64));
    double sum = 0, norm = 0;
    for (std::size_t i = 0; i < many.transfer.coefficients.size(); ++i) {
      sum += std::pow(double(solved.transfer.coefficients[i]) - double(many.transfer.coefficients[i]), 2);
      norm += std::pow(double(open.transfer.coefficients[i]), 2);
    }
    INFO("tolerance " << tolerance);
    CHECK(std::sqrt(sum / norm) <= tolerance);
  }
}

TEST_CASE("options out of range are wrong usage and named", "[baker]") {
  const auto with = [](auto change) {
    BakeOptions options = optionsOf(TransferKind::interreflected, 3, 64);
    change(options);
    return options;
  };
  CHECK(kindOf(with([](BakeOptions& o) { o.order = 0; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.order = 33; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.rays = -1; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.rays = (1 << 20) + 1; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.tolerance = 0; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.tolerance = std::nan(""); })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.bounces = -2; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.bounces = 10001; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.maxDistance = 0; })) == ErrorKind::usage);
  CHECK(kindOf(with([](BakeOptions& o) { o.maxDistance = std::nan(""); })) == ErrorKind::usage);
  try {
    bakeAll(pointsOf(shapes::tetrahedron()), with([](BakeOptions& o) { o.order = 40; }));
    FAIL("no Error was thrown");
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Catch::Contains("order") && Catch::Contains("40") && Catch::Contains("32"));
  }
}

TEST_CASE("the highest order and the fewest rays work", "[baker]") {
  const PointBake bake = bakeAll(pointsOf(shapes::corner(1)), reflected(32, 1, 1));
  CHECK(bake.rays == 16);
  CHECK(bake.transfer.stride() == 1024);
  for (const float value : bake.transfer.coefficients) REQUIRE(std::isfinite(value));
}

TEST_CASE("a bake stops soon after its progress says so", "[baker]") {
  const LightingPoints points = pointsOf(shapes::inwardSphere(5));
  for (const std::string stage : {"building", "tracing", "reflecting"}) {
    for (const int threads : {1, 2}) {
      bool begun = false;
      Progress progress([&](const ProgressState& state) {
        begun |= state.stage == stage;
        return !begun;
      });
      const Parallel parallel(threads);
      // Of these rays, a whole bake would take many seconds; a block of points takes milliseconds.
      const int rays = stage == "tracing" ? 65536 : 16;
      const auto start = std::chrono::steady_clock::now();
      try {
        BakeOptions options = reflected(2, rays, 10000);
        bakePoints(points, {}, options, parallel, progress);
        FAIL("no Error was thrown");
      } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::cancelled);
      }
      CHECK(begun);
      CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 20);
    }
  }
}
