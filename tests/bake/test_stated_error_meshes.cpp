// Is the stated error true? Bakes of scans and of made scenes beside references of many more rays: the stated RMS error
// is the true one within a factor of 1.5, and fewer than one point in a hundred errs by more than three times what it
// states.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "bake/stated_error.h"
#include "bake/support.h"
#include "mesh/mesh_reader.h"
#include "sh/irradiance.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

constexpr double kFactor = 1.5;
constexpr double kBeyondShare = 0.01;
constexpr std::uint64_t kReferenceSeed = 0x5EED;

/// How stated and true errors of some points compare; each point counts by its area.
class Agreement {
 public:
  void add(double area, double stated, double truth) {
    stated2_ += area * stated * stated;
    truth2_ += area * truth * truth;
    ++count_;
    beyond_ += truth > 3 * stated ? 1 : 0;
  }
  double statedRms() const { return std::sqrt(stated2_); }
  double trueRms() const { return std::sqrt(truth2_); }
  double ratio() const { return statedRms() / trueRms(); }
  double beyondShare() const { return beyond_ / count_; }

 private:
  double stated2_ = 0, truth2_ = 0, count_ = 0, beyond_ = 0;
};

struct Case {
  Mesh mesh;
  TransferKind kind;
  int order, referenceRays;
  std::size_t points;  // compared, spread over the mesh
};

/// At least sixteen times the rays of what is judged: the reference's own error is an eighth, 1 % of the RMS.
void check(const Case& c, std::initializer_list<int> rayCounts) {
  constexpr float kAlbedo = 0.8f;
  const LightingPoints points = pointsOf(c.mesh, {kAlbedo, kAlbedo, kAlbedo});
  std::vector<std::uint32_t> chosen;
  const std::size_t n = std::min(c.points, points.size());
  for (std::size_t i = 0; i < n; ++i) chosen.push_back(std::uint32_t(i * points.size() / n));
  BakeOptions options = optionsOf(c.kind, c.order, c.referenceRays, kReferenceSeed);
  options.tolerance = 1e-3;
  const PointBake reference =
      c.kind == TransferKind::shadowed ? bakeSome(points, chosen, options) : bakeAll(points, options);
  const std::vector<double> areas = pointAreas(points);
  const double norm = sh::unshadowedNorm(c.order) * double(kAlbedo);
  for (const int rays : rayCounts) {
    REQUIRE(16 * rays <= c.referenceRays);
    const PointBake bake = bakeAll(points, optionsOf(c.kind, c.order, rays));
    Agreement agreement;
    for (const std::uint32_t p : chosen) {
      const auto is = bake.transfer.at(p, 0), should = reference.transfer.at(p, 0);
      double e2 = 0;
      for (std::size_t k = 0; k < is.size(); ++k) e2 += std::pow(double(is[k]) - double(should[k]), 2);
      agreement.add(areas[p], double(bake.transfer.error[p]), std::sqrt(e2) / norm);
    }
    INFO(c.mesh.source << ", order " << c.order << ", " << rays << " rays: stated " << agreement.statedRms()
                       << ", true " << agreement.trueRms() << ", " << 100 * agreement.beyondShare() << " % beyond 3x");
    CHECK(agreement.ratio() < kFactor);
    CHECK(agreement.ratio() > 1 / kFactor);
    CHECK(agreement.beyondShare() < kBeyondShare);
  }
}

void checkShadowed(const Mesh& mesh) {
  check({mesh, TransferKind::shadowed, 4, 8192, 400}, {64, 256});
}

void checkInterreflected(const Mesh& mesh) {
  check({mesh, TransferKind::interreflected, 4, 4096, 4000}, {64, 256});
}

/// Real meshes; none where the folder is absent.
std::vector<Mesh> scans(std::initializer_list<const char*> names) {
  const std::filesystem::path folder = std::filesystem::path(SHBAKE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: there is no folder of real meshes beside the project");
    return {};
  }
  std::vector<Mesh> meshes;
  Progress progress;
  for (const char* name : names) meshes.push_back(readMesh((folder / name).string(), progress));
  return meshes;
}

}  // namespace

TEST_CASE("stated errors are true: rooms, cities, cavities", "[stated_error]") {
  for (const Mesh& mesh : {shapes::cornellRoom(8), shapes::city(4, 4, 4), shapes::city(6, 2, 2),
                           shapes::openCavity(4, 0.08, 25), shapes::icosphere(4, 0.25), shapes::boxesOnGround()}) {
    checkShadowed(mesh);
  }
}

TEST_CASE("stated errors are true: orders 2 and 8", "[stated_error]") {
  for (const int order : {2, 8}) {
    for (const Mesh& mesh : {shapes::cornellRoom(8), shapes::city(4, 4, 4), shapes::openCavity(4, 0.08, 25)}) {
      check({mesh, TransferKind::shadowed, order, 8192, 400}, {64, 256});
    }
  }
}

TEST_CASE("stated errors are true: the bunny", "[stated_error]") {
  for (const Mesh& mesh : scans({"stanford-bunny.obj"})) checkShadowed(mesh);
}

TEST_CASE("stated errors are true: the armadillo", "[stated_error]") {
  for (const Mesh& mesh : scans({"igl_armadillo.obj"})) checkShadowed(mesh);
}

TEST_CASE("stated errors are true: parts and machined shapes", "[stated_error]") {
  for (const Mesh& mesh : scans({"rocker-arm.obj", "fandisk.obj", "igl_halftunnel.off", "teapot.obj"})) {
    checkShadowed(mesh);
  }
}

TEST_CASE("stated errors are true: animals and heads", "[stated_error]") {
  for (const Mesh& mesh : scans({"spot.obj", "cow.obj", "suzanne.obj", "igl_decimated-knight.off"}))
    checkShadowed(mesh);
}

TEST_CASE("stated errors are true with reflections: made scenes", "[stated_error]") {
  for (const Mesh& mesh : {shapes::cornellRoom(6), shapes::city(3, 2, 3), shapes::openCavity(3, 0.08, 25)}) {
    checkInterreflected(mesh);
  }
}

TEST_CASE("stated errors are true with reflections: real meshes", "[stated_error]") {
  for (const Mesh& mesh : scans({"suzanne.obj", "igl_decimated-knight.off", "igl_halftunnel.off"})) {
    checkInterreflected(mesh);
  }
}
