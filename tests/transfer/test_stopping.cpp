// Reading, writing and comparing large bakes can be stopped, soon, wherever they are.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "base/passes.h"
#include "support/shapes.h"
#include "support/stopping.h"
#include "transfer/baked_ply.h"
#include "transfer/compare.h"

using namespace shbake;

namespace {

/// 40962 vertices: several blocks in every pass.
BakedPly sphere() {
  BakedPly baked;
  baked.mesh = shapes::icosphere(6);
  for (const Vec3d& p : baked.mesh.positions) baked.mesh.vertexNormals.push_back(Vec3f(p));
  const std::size_t vertices = baked.mesh.positions.size();
  baked.transfer.order = 2;
  baked.transfer.coefficients.assign(vertices * baked.transfer.stride(), 0.25f);
  baked.transfer.error.assign(vertices, 0.01f);
  baked.transfer.visibility.assign(vertices, 0.5f);
  for (std::size_t v = 0; v < vertices; ++v) baked.sourceVertex.push_back(static_cast<std::uint32_t>(v));
  return baked;
}

}  // namespace

TEST_CASE("Stopping: a bake that is compared") {
  const BakedPly baked = sphere();
  // 13 passes over two meshes count alike; the longest blocks are those of the passes over one mesh's vertices. The
  // albedo is the one thing that is told in one go.
  const double most = 2.0 * kProgressBlock / 13 + 1e-6;
  checkStopping([&](Progress& progress) { compareTransfer(baked, baked, progress); }, {{"comparing", most}});
}

TEST_CASE("Stopping: a bake that is written and read") {
  const BakedPly baked = sphere();
  const std::string path = (std::filesystem::temp_directory_path() / "shbake_test_stopping.ply").string();
  const auto write = [&](Progress& progress) {
    writeBakedPly(path, baked.mesh, baked.transfer, baked.facts, baked.sourceVertex, {}, progress);
  };
  std::filesystem::remove(path);
  // A block of rows holds 128 KiB, of which a face takes 13 bytes.
  checkStopping(write, {{"checking results", kProgressBlock / 5.0 + 1e-6}, {"writing " + path, 131072 / 13.0 + 1}});
  CHECK(std::filesystem::exists(path));

  const auto read = [&](Progress& progress) { readBakedPly(path, progress); };
  checkStopping(read, {{"reading " + path, double(1 << 20)}, {"unpacking", kProgressBlock / 4.0 + 1e-6}});
  std::filesystem::remove(path);
}
