// Meshes named by their defect.
#include "support/defects.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "support/surfaces.h"
#include "support/transforms.h"

namespace shbake::shapes {
namespace {

Mesh made(const char* name, std::vector<Vec3d> positions, std::vector<Triangle> triangles) {
  Mesh mesh;
  mesh.source = name;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}

// A cone without a bottom: its tip at the origin (vertex 0), its rim of n vertices at z = height.
Mesh openCone(int n, double height) {
  Mesh mesh = made("cone", {{0, 0, 0}}, {});
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * std::numbers::pi * i / n;
    mesh.positions.push_back({std::cos(phi), std::sin(phi), height});
  }
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({0, static_cast<std::uint32_t>((i + 1) % n + 1), static_cast<std::uint32_t>(i + 1)});
  }
  return mesh;
}

}  // namespace

Mesh threeFacesOnEdge() {
  const double c = -0.5, s = std::sqrt(0.75);
  return made("three faces on an edge", {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {c, s, 0.5}, {c, -s, 0.5}},
              {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
}

Mesh bowTie() {
  return made("bow-tie", {{0, 0, 0}, {1, -1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
              {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 6}});
}

Mesh conesTipToTip() {
  Mesh mesh = openCone(8, 1);
  const Mesh lower = flipped(openCone(8, -1));
  const auto offset = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  mesh.positions.insert(mesh.positions.end(), lower.positions.begin() + 1, lower.positions.end());
  for (const Triangle& t : lower.triangles) mesh.triangles.push_back({0, t[1] + offset, t[2] + offset});
  mesh.source = "cones tip to tip";
  return mesh;
}

Mesh moebiusStrip(int n) {
  Mesh mesh = made("Moebius strip", {}, {});
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * std::numbers::pi * i / n;
    for (int side : {-1, 1}) {
      const double r = 1 + 0.3 * side * std::cos(phi / 2);
      mesh.positions.push_back({r * std::cos(phi), r * std::sin(phi), 0.3 * side * std::sin(phi / 2)});
    }
  }
  for (int i = 0; i < n; ++i) {
    const auto a = static_cast<std::uint32_t>(2 * i), b = a + 1;
    // After one turn the two sides have changed places.
    const std::uint32_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({b, d, c});
  }
  return mesh;
}

Mesh duplicateFaces() {
  Mesh mesh = octahedron();
  const std::vector<Triangle> once = mesh.triangles;
  for (const Triangle& t : once) mesh.triangles.push_back({t[1], t[2], t[0]});
  mesh.source = "duplicate faces";
  return mesh;
}

Mesh doubledSheet(int n) {
  Mesh mesh = grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, n);
  const std::vector<Triangle> front = mesh.triangles;
  for (const Triangle& t : front) mesh.triangles.push_back({t[0], t[2], t[1]});
  mesh.source = "doubled sheet";
  return mesh;
}

Mesh flippedFaces(int level, int every) {
  Mesh mesh = icosphere(level);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += static_cast<std::size_t>(every)) {
    std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
  }
  mesh.source = "flipped faces";
  return mesh;
}

Mesh degenerateFaces() {
  return made("degenerate faces", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 3}},
              {{0, 1, 2}, {0, 2, 3}, {0, 1, 1}, {1, 2, 4}, {5, 5, 5}});
}

Mesh collinearFace() {
  return made("collinear face", {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, -1, 0}},
              {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {1, 0, 5}, {2, 1, 5}});
}

Mesh isolatedVertices() {
  return made("isolated vertices", {{1e9, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, -1e9, 7}, {0, 1, 0}, {5, 5, 5}},
              {{1, 2, 4}});
}

Mesh onlyDegenerate() {
  return made("only degenerate faces", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {2, 2, 2}});
}

std::vector<Mesh> defects() {
  return {threeFacesOnEdge(), bowTie(),          conesTipToTip(), moebiusStrip(),     duplicateFaces(), doubledSheet(),
          flippedFaces(),     degenerateFaces(), collinearFace(), isolatedVertices(), onlyDegenerate()};
}

}  // namespace shbake::shapes
