// Baked meshes for the tests of this layer.
#pragma once

#include <array>

#include "mesh/test_ply_files.h"
#include "sh/irradiance.h"
#include "transfer/baked_ply.h"

namespace shbake::bakedtest {

/// Any mesh with all that it can carry, and any finite transfer.
inline BakedPly randomBake(std::uint64_t seed, int order, int channels) {
  plytest::Random random(seed);
  BakedPly baked;
  baked.mesh = plytest::randomMesh(seed);
  baked.mesh.cornerNormals.clear();
  const std::size_t vertices = baked.mesh.positions.size();
  baked.mesh.vertexNormals.clear();
  for (std::size_t v = 0; v < vertices; ++v) {
    baked.mesh.vertexNormals.push_back(Vec3f(random.anyFloat(), random.anyFloat(), random.anyFloat()));
  }
  TransferSet& t = baked.transfer;
  t.order = order;
  t.channels = channels;
  for (std::size_t i = 0; i < vertices * t.stride(); ++i) t.coefficients.push_back(random.anyFloat());
  if (random.below(2) == 0) {
    for (std::size_t v = 0; v < vertices; ++v) t.error.push_back(std::abs(random.anyFloat()));
  }
  if (random.below(2) == 0) {
    for (std::size_t v = 0; v < vertices; ++v) t.visibility.push_back(static_cast<float>(random.unit()));
  }
  if (random.below(2) == 0) {
    for (std::size_t v = 0; v < vertices; ++v)
      baked.sourceVertex.push_back(static_cast<std::uint32_t>(random.below(vertices)));
  }
  baked.facts.version = "1.0";
  baked.facts.kind = TransferKind::shadowed;
  baked.facts.rays = 64;
  baked.facts.sampler = "cosine-fibonacci";
  baked.facts.lightingPoints = vertices;
  baked.facts.sourceVertices = vertices;
  baked.facts.source = "random mesh.ply";
  return baked;
}

/// An octahedron with unit normals and the transfer of open points: what every other oracle is relative to.
inline BakedPly openOctahedron(int order, int channels, const Rgb& albedo) {
  BakedPly baked;
  Mesh& mesh = baked.mesh;
  mesh.source = "octahedron.ply";
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  for (const Vec3d& p : mesh.positions) mesh.vertexNormals.push_back(Vec3f(p));
  baked.transfer.order = order;
  baked.transfer.channels = channels;
  std::vector<double> row(static_cast<std::size_t>(order * order));
  const std::array rho = {albedo.x, albedo.y, albedo.z};
  for (const Vec3d& p : mesh.positions) {
    for (int c = 0; c < channels; ++c) {
      sh::unshadowedTransfer(order, p, static_cast<double>(rho[static_cast<std::size_t>(c)]), row);
      for (const double t : row) baked.transfer.coefficients.push_back(static_cast<float>(t));
    }
  }
  baked.stated = true;
  baked.facts.kind = TransferKind::unshadowed;
  baked.facts.albedo = {true, AlbedoOrigin::uniform, albedo, false};
  return baked;
}

}  // namespace shbake::bakedtest
