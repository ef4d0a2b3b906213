// Refinement of flat regions: what it makes, and what it leaves alone.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "mesh/mesh_check.h"
#include "mesh/refine.h"
#include "refine_checks.h"
#include "support/shapes.h"

using namespace shbake;

namespace {

const double kRoot3 = std::sqrt(3.0);

/// Vertices of the refined mesh behind those of the input.
std::vector<Vec3d> newPositions(const Mesh& before, const RefinedMesh& after) {
  return {after.mesh.positions.begin() + static_cast<std::ptrdiff_t>(before.positions.size()),
          after.mesh.positions.end()};
}

Mesh cylinderWithCaps() {
  return inFloats(shapes::lathe({{1, 0}, {1, 1}, {1, 2}}, 64));
}

}  // namespace

TEST_CASE("a cube of twelve triangles gets as many vertices as equilateral triangles have", "[refine]") {
  const Mesh cube = shapes::cube();
  for (const double length : {0.3, 0.1, 0.03, 0.011}) {
    INFO("length " << length);
    const RefinedMesh refined = refinedTo(cube, length);
    checkKept(cube, refined);
    CHECK(refined.report.regions == 6);
    CHECK(refined.report.refined == 6);
    CHECK(refined.report.left.empty());
    CHECK(areaOf(refined.mesh) == Approx(6).epsilon(1e-6));
    CHECK(volumeOf(refined.mesh) == Approx(1).epsilon(1e-6));
    // Six sides of area 1, a vertex for each sqrt(3)/2 L^2 of them. Halving makes edges of 0.71 to 1.41 L, and the rows
    // along them lie up to a quarter of a row nearer or farther: within a row of the border, which is all of the side
    // where L is large, there are up to 1.41 times as many, or as few.
    const double ideal = 6 / (kRoot3 / 2 * length * length);
    const double border = 12 / length;
    CHECK(static_cast<double>(refined.mesh.positions.size()) >= ideal - border);
    CHECK(static_cast<double>(refined.mesh.positions.size()) <= ideal + border);
    const std::vector<double> sides = newSides(cube, refined);
    const auto longer = std::count_if(sides.begin(), sides.end(), [&](double s) { return s > 1.5 * length; });
    CHECK(static_cast<double>(longer) <= 0.02 * static_cast<double>(sides.size()));
    CHECK(*std::max_element(sides.begin(), sides.end()) <= 2 * length);
    CHECK(*std::min_element(sides.begin(), sides.end()) >= kRoot3 / 4 * length);
  }
}

TEST_CASE("what is fine enough stays as it is", "[refine]") {
  for (const Mesh& mesh :
       {shapes::cube(), shapes::redFloorWhiteWall(4), shapes::grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 7, 5)}) {
    const RefinedMesh refined = refinedTo(mesh, 1.2);
    CHECK(sameMesh(refined.mesh, mesh));
    CHECK(refined.report.refined == 0);
    CHECK(sameMesh(refinedTo(mesh, std::numeric_limits<double>::infinity()).mesh, mesh));
  }
  // What stands on a floor gets rows along its foot, and nothing else changes.
  const Mesh room = shapes::cornellRoom(4);
  const RefinedMesh rows = refinedTo(room, 1.2);
  checkKept(room, rows);
  CHECK(rows.report.refined == 1);
  CHECK(rows.mesh.positions.size() > room.positions.size());
  CHECK(rows.mesh.positions.size() <= room.positions.size() + 16);
  CHECK(sameMesh(refinedTo(room, std::numeric_limits<double>::infinity()).mesh, room));
  // What has been refined has no edges that would be divided again, but for the few near corners.
  const Mesh once = refinedTo(shapes::cube(), 0.1).mesh;
  const RefinedMesh twice = refinedTo(once, 0.1);
  CHECK(twice.mesh.positions.size() - once.positions.size() <= once.positions.size() / 50);
}

TEST_CASE("tilted planes far from the origin and of any size stay planes, to rounding", "[refine]") {
  const shapes::Matrix3 turn = shapes::rotationAbout({0.3, -0.5, 0.8}, 1.234);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double shift : {0.0, 100.0, 1e4}) {
      for (const bool doubles : {false, true}) {
        INFO("scale " << scale << ", shift " << shift << ", doubles " << doubles);
        Mesh box = shapes::box({0, 0, 0}, {40, 30, 20});
        box = shapes::scaled(shapes::translated(shapes::rotated(box, turn), {shift, -shift, shift / 3}), scale);
        box.doublePositions = doubles;
        if (!doubles) box = inFloats(box);
        const RefinedMesh refined = refinedTo(box, 2 * scale);
        checkKept(box, refined);
        CHECK(refined.report.refined == 6);
        CHECK(refined.mesh.positions.size() > 1200);
        // Each new point of a border moves it by up to an ulp, to either side.
        const double ulp = (doubles ? 0x1p-52 : 0x1p-23) * (shift + 50);
        CHECK(areaOf(refined.mesh) == Approx(areaOf(box)).epsilon(1e-6 + ulp / 20));
        CHECK(volumeOf(shapes::translated(refined.mesh, -box.positions[0])) ==
              Approx(24000 * scale * scale * scale).epsilon(1e-6 + ulp));
      }
    }
  }
}

TEST_CASE("new vertices lie on the faces they come from", "[refine]") {
  Mesh sheet =
      shapes::rotated(shapes::grid({100, 50, 20}, {9, 0, 0}, {1, 7, 0}, 1, 1), shapes::rotationAbout({1, 2, 3}, 0.7));
  for (const bool doubles : {false, true}) {
    sheet.doublePositions = doubles;
    const Mesh mesh = doubles ? sheet : inFloats(sheet);
    const RefinedMesh refined = refinedTo(mesh, 0.2);
    const double ulp = (doubles ? 0x1p-52 : 0x1p-23) * 128;
    for (const Vec3d& p : newPositions(mesh, refined)) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d n = normalized(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
        nearest = std::min(nearest, std::abs(dot(n, p - mesh.positions[a])));
      }
      REQUIRE(nearest <= 4 * ulp);
    }
  }
}

TEST_CASE("curved faces stay, and so do their edges", "[refine]") {
  const Mesh mesh = cylinderWithCaps();
  const RefinedMesh refined = refinedTo(mesh, 0.05);
  checkKept(mesh, refined);
  CHECK(refined.report.regions == 2);
  std::vector<Triangle> side, sideAfter;
  const auto isSide = [&](const Triangle& t) {
    const auto& [a, b, c] = t;
    return std::abs(mesh.positions[a].z - mesh.positions[b].z) + std::abs(mesh.positions[b].z - mesh.positions[c].z) >
           0.5;
  };
  for (const Triangle& t : mesh.triangles) {
    if (isSide(t)) side.push_back(t);
  }
  for (std::size_t f = 0; f < refined.mesh.triangles.size(); ++f) {
    if (isSide(mesh.triangles[refined.sourceFace[f]])) sideAfter.push_back(refined.mesh.triangles[f]);
  }
  CHECK(side.size() == 4 * 64);
  CHECK(sideAfter == side);
  // The caps' rims of 64 edges are the sides', and stay; their insides get points.
  std::size_t inside = 0;
  for (const Vec3d& p : newPositions(mesh, refined)) {
    CHECK(std::hypot(p.x, p.y) < 1);
    CHECK((p.z == 0 || p.z == 2));
    ++inside;
  }
  CHECK(static_cast<double>(inside) == Approx(2 * std::numbers::pi / (kRoot3 / 2 * 0.05 * 0.05)).epsilon(0.1));
}

TEST_CASE("meshes without a flat region come out as they are", "[refine]") {
  for (const Mesh& mesh : {shapes::icosphere(3), shapes::icosphere(4, 0.1), shapes::openCavity(3, 0.1, 20)}) {
    const RefinedMesh refined = refinedTo(mesh, 0.001);
    CHECK(refined.report.regions == 0);
    CHECK(sameMesh(refined.mesh, mesh));
  }
}

TEST_CASE("two regions with different lengths agree on their border", "[refine]") {
  // A floor and a wall; the wall wants much shorter edges, as a shadow on it might.
  const Mesh mesh = shapes::floorBesideWall(1, 1, 1);
  Mesh corner = shapes::corner(1);
  const auto fineBySide = [&](std::uint32_t face, const Vec3d&) { return face < 2 ? 0.02 : 0.3; };
  const RefinedMesh refined = refinedBy(corner, fineBySide);
  checkKept(corner, refined);
  std::size_t onBorder = 0;
  for (const Vec3d& p : newPositions(corner, refined)) onBorder += (p.x == 0) + (p.y == 0) + (p.z == 0) == 2;
  // The fine square has four edges of 64 pieces of 1/64; the other five have two or four of them.
  CHECK(onBorder >= 2 * 63);
  checkKept(mesh, refinedBy(mesh, [](std::uint32_t f, const Vec3d&) { return f % 2 ? 0.5 : 0.03; }));
}

TEST_CASE("the density of vertices follows a graded length over four orders of magnitude", "[refine]") {
  const Mesh mesh = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const Vec3d spot(0.2, 0.3, 0);
  const auto graded = [&](std::uint32_t, const Vec3d& p) { return 1e-4 + 0.4 * length(p - spot); };
  const RefinedMesh refined = refinedBy(mesh, graded);
  checkKept(mesh, refined);
  // The integral of 1 / (sqrt(3)/2 h^2) over a disc of radius R around the spot: 2 pi / (sqrt(3)/2 0.16) times
  // log(h(R)/h(0)) + h(0)/h(R) - 1.
  const double most = 1e-4 + 0.4,
               ideal = 2 * std::numbers::pi / (kRoot3 / 2 * 0.16) * (std::log(most / 1e-4) + 1e-4 / most - 1);
  // Sides are 0.71 to 1.41 of the length wanted, evenly over its logarithm, and there are corners outside the disc.
  CHECK(static_cast<double>(refined.mesh.positions.size()) > ideal / 2);
  CHECK(static_cast<double>(refined.mesh.positions.size()) < ideal * 2);
  double worst = 0;
  for (const Triangle& t : refined.mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d a = refined.mesh.positions[t[k]], b = refined.mesh.positions[t[(k + 1) % 3]];
      worst = std::max(worst, length(b - a) / graded(0, (a + b) * 0.5));
    }
  }
  // Where triangles of two sizes meet, and the length has grown by half of it across the larger.
  CHECK(worst < 3);
}

TEST_CASE("borders follow a length that dips along them", "[refine]") {
  const Mesh mesh = shapes::corner(1);
  const Vec3d dip(0, 0.37, 0);
  const auto graded = [&](std::uint32_t, const Vec3d& p) { return 0.002 + 0.3 * length(p - dip); };
  const RefinedMesh refined = refinedBy(mesh, graded);
  checkKept(mesh, refined);
  std::vector<double> along{0, 1};
  for (const Vec3d& p : newPositions(mesh, refined)) {
    if (p.x == 0 && p.z == 0) along.push_back(p.y);
  }
  std::sort(along.begin(), along.end());
  REQUIRE(along.size() > 10);
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    const double wanted = graded(0, {0, (along[i] + along[i + 1]) / 2, 0});
    CHECK(along[i + 1] - along[i] <= std::sqrt(2.0) * wanted * (1 + 1e-6));
    CHECK(along[i + 1] - along[i] >= wanted / 3);
  }
}

TEST_CASE("a wall on the middle of a floor: three sheets on an edge are divided alike", "[refine]") {
  Mesh mesh = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 1);
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{0, -1, 1}, {0, 1, 1}});
  mesh.triangles.insert(mesh.triangles.end(), {{1, 4, base}, {4, base + 1, base}});
  const RefinedMesh refined = refinedTo(mesh, 0.1);
  checkKept(mesh, refined);
  Progress progress;
  const MeshCheck check = checkMesh(refined.mesh, progress);
  CHECK(check.nonManifoldEdges.count == 16);
  checkKept(shapes::threeFacesOnEdge(), refinedTo(shapes::threeFacesOnEdge(), 0.05));
}

TEST_CASE("no face of the ground reaches from under a box to beside it", "[refine]") {
  for (const double sunk : {0.0, 0.2}) {
    for (const double length : {0.7, 0.3, 0.1, 0.03}) {
      INFO("sunk " << sunk << ", length " << length);
      // Vertices of the ground under the box and around it, of which some are near its foot.
      const Mesh ground = shapes::grid({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 9, 9);
      const Mesh mesh = inFloats(shapes::merged(ground, shapes::box({-0.51, -0.3, -sunk}, {0.6, 0.44, 1})));
      const RefinedMesh refined = refinedTo(mesh, length);
      checkKept(mesh, refined);
      CHECK(refined.report.left.empty());
      std::size_t across = 0;
      for (std::size_t f = 0; f < refined.mesh.triangles.size(); ++f) {
        if (refined.sourceFace[f] >= ground.triangles.size()) continue;
        bool under = false, beside = false;
        for (const std::uint32_t v : refined.mesh.triangles[f]) {
          const Vec3d& p = refined.mesh.positions[v];
          const double out = std::max({-0.51 - p.x, p.x - 0.6, -0.3 - p.y, p.y - 0.44});
          under |= out < -0.001;
          beside |= out > 0.001;
        }
        across += under && beside;
      }
      CHECK(across == 0);
    }
  }
}

TEST_CASE("rows along lines that cross are refined all the same", "[refine]") {
  const Mesh ground = shapes::grid({-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
  const Mesh mesh = shapes::merged(shapes::merged(ground, shapes::box({-1, -0.1, -0.5}, {1, 0.1, 1})),
                                   shapes::box({-0.2, -1, -0.5}, {0.1, 1, 1}));
  const RefinedMesh refined = refinedTo(mesh, 0.2);
  checkKept(mesh, refined);
  CHECK(refined.report.left.empty());
}

TEST_CASE("the result does not depend on the number of threads", "[refine]") {
  const Mesh city = shapes::city(4, 1, 1);
  const auto length = [](std::uint32_t, const Vec3d& p) { return 0.02 + 0.1 * std::abs(p.x); };
  const RefinedMesh one = refinedBy(city, length, 1);
  for (const int threads : {2, 5}) {
    const RefinedMesh more = refinedBy(city, length, threads);
    CHECK(sameMesh(one.mesh, more.mesh));
    CHECK(one.sourceFace == more.sourceFace);
  }
}

TEST_CASE("more vertices than allowed are refused, with a length that fits", "[refine]") {
  const Mesh cube = shapes::cube();
  const RefineOptions few{.maxVertices = 2000};
  try {
    refinedTo(cube, 0.001, few);
    FAIL("nothing was refused");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::work);
    const std::string text = error.parts().remedy;
    CAPTURE(text);
    const std::string before = "a length of ";
    REQUIRE(text.starts_with(before));
    const double fits = std::stod(text.substr(before.size()));
    CHECK(refinedTo(cube, fits, few).mesh.positions.size() <= 2000);
    CHECK(refinedTo(cube, fits / 1.3, {.maxVertices = 100000}).mesh.positions.size() > 2000);
  }
  // A length that the faces' centres do not tell.
  Progress progress;
  const EdgeLength dip = [](std::uint32_t, const Vec3d& p) {
    return 1e-5 + 0.01 * length(p - Vec3d(-0.5, -0.5, -0.5));
  };
  CHECK_THROWS_AS(refineFlatRegions(cube, few, dip, Parallel(1), progress), Error);
}

TEST_CASE("lengths that are not positive are refused", "[refine]") {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(refinedTo(shapes::cube(), bad), Error);
  }
  CHECK_THROWS_AS(refinedTo(shapes::cube(), 1, {.flatDegrees = -1}), Error);
  Mesh broken = shapes::cube();
  broken.triangles[3][1] = 99;
  CHECK_THROWS_AS(refinedTo(broken, 1), Error);
  broken = shapes::cube();
  broken.positions[2].x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(refinedTo(broken, 1), Error);
}

TEST_CASE("a refinement can be stopped while it triangulates", "[refine]") {
  const Mesh cube = shapes::cube();
  std::atomic<int> reports = 0;
  bool inRefining = false;
  Progress progress(
      [&](const ProgressState& state) {
        inRefining = state.stage == "refining" && state.done > 0;
        if (inRefining) ++reports;
        return reports < 3;
      },
      Progress::Duration(0));
  try {
    refineFlatRegions(
        cube, {}, [](std::uint32_t, const Vec3d&) { return 0.005; }, Parallel(1), progress);
    FAIL("it went on");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::cancelled);
    CHECK(reports == 3);
  }
}

TEST_CASE("an empty mesh is no error", "[refine]") {
  CHECK(sameMesh(refinedTo(Mesh{}, 1).mesh, Mesh{}));
}
