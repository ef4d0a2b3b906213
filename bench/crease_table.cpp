// Prints what the crease angle does to meshes: the two tables in docs/lighting-points.md.
//
// Usage: crease_table MESH...
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/disjoint_sets.h"
#include "mesh/face_fans.h"
#include "mesh/lighting_points.h"
#include "mesh/mesh_reader.h"

using namespace shbake;

namespace {

constexpr int kAngles[] = {20, 30, 40, 45, 50, 55, 60, 70, 80};
// Creases that hang together over this many edges are a feature of the shape rather than noise.
constexpr int kChain = 10;

void printHeader(const char* what) {
  std::printf("\n| mesh | %s |", what);
  for (const int angle : kAngles) std::printf(" %d° |", angle);
  std::printf("\n|---|---|");
  for (std::size_t i = 0; i < std::size(kAngles); ++i) std::printf("---|");
  std::printf("\n");
}

// The points beyond one a position, in percent of the positions, for each crease angle.
void printSplits(const std::string& name, const Mesh& mesh) {
  Progress progress;
  for (std::size_t i = 0; i < std::size(kAngles); ++i) {
    const LightingPoints points =
        makeLightingPoints(mesh, {.normals = NormalSource::smooth, .creaseDegrees = double(kAngles[i])}, {}, progress);
    const std::size_t positions = points.positions.size();
    if (i == 0) std::printf("| %s | %zu |", name.c_str(), positions);
    std::printf(" %.2f |", 100.0 * static_cast<double>(points.size() - positions) / static_cast<double>(positions));
  }
  std::printf("\n");
}

// An edge between two faces and the angle between their normals in degrees.
struct Bend {
  std::uint32_t from, to;
  double degrees;
};

std::vector<Bend> bendsOf(const Mesh& mesh) {
  Progress progress;
  const LightingPoints points = makeLightingPoints(mesh, {.normals = NormalSource::smooth}, {}, progress);
  std::vector<Triangle> faces = points.faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (points.turned[f]) std::swap(faces[f][1], faces[f][2]);
  }
  Passes passes(progress, "bends", faces.size(), "faces", 5);
  const std::vector<std::uint32_t> opposite =
      oppositeHalfEdges(points.positions, faces, cornersAtPositions(faces, points.positions.size(), passes), passes);
  std::vector<Bend> bends;
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    if (opposite[h] == kNoCorner || opposite[h] < h) continue;
    const Vec3d here = faceNormal(points.positions, faces[h / 3]),
                there = faceNormal(points.positions, faces[opposite[h] / 3]);
    bends.push_back(
        {positionAt(faces, h), positionAt(faces, nextCorner(h)), angleBetween(here, there) * 180 / std::numbers::pi});
  }
  return bends;
}

// Creases in chains of kChain or more, in percent of all creases, for each crease angle.
void printChains(const std::string& name, const Mesh& mesh) {
  const std::vector<Bend> bends = bendsOf(mesh);
  std::printf("| %s | %zu |", name.c_str(), bends.size());
  for (const int angle : kAngles) {
    DisjointSets chains(mesh.positions.size());
    std::map<std::uint32_t, int> lengths;
    for (const Bend& b : bends) {
      if (b.degrees > angle) chains.unite(b.from, b.to);
    }
    int creases = 0, chained = 0;
    for (const Bend& b : bends) {
      if (b.degrees > angle) ++lengths[chains.find(b.from)], ++creases;
    }
    for (const auto& [root, length] : lengths) chained += length >= kChain ? length : 0;
    std::printf(" %.0f%% of %d |", creases > 0 ? 100.0 * chained / creases : 0.0, creases);
  }
  std::printf("\n");
}

}  // namespace

int main(int count, char** arguments) {
  try {
    std::vector<std::pair<std::string, Mesh>> meshes;
    for (int i = 1; i < count; ++i) {
      Progress progress;
      meshes.emplace_back(std::filesystem::path(arguments[i]).stem().string(), readMesh(arguments[i], progress));
    }
    std::printf("Points beyond one a position, in percent of the positions\n");
    printHeader("positions");
    for (const auto& [name, mesh] : meshes) printSplits(name, mesh);
    std::printf("\nCreases in chains of %d edges or more\n", kChain);
    printHeader("edges");
    for (const auto& [name, mesh] : meshes) printChains(name, mesh);
  } catch (const Error& error) {
    std::fprintf(stderr, "crease_table: %s\n", error.what());
    return 1;
  }
  return 0;
}
