// Single surfaces with known properties.
#include "support/surfaces.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>

#include "support/transforms.h"

namespace shbake::shapes {
namespace {

std::uint32_t addVertex(Mesh& mesh, Vec3d p) {
  mesh.positions.push_back(p);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

// The icosahedron, its corners on the unit sphere.
Mesh icosahedron() {
  const double t = std::numbers::phi;
  Mesh mesh;
  for (Vec3d p :
       {Vec3d(-1, t, 0), Vec3d(1, t, 0), Vec3d(-1, -t, 0), Vec3d(1, -t, 0), Vec3d(0, -1, t), Vec3d(0, 1, t),
        Vec3d(0, -1, -t), Vec3d(0, 1, -t), Vec3d(t, 0, -1), Vec3d(t, 0, 1), Vec3d(-t, 0, -1), Vec3d(-t, 0, 1)}) {
    addVertex(mesh, normalized(p));
  }
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

// Splits every triangle into four with the new vertices on the unit sphere.
void subdivide(Mesh& mesh) {
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  middles.reserve(mesh.triangles.size() * 2);
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
    const auto [entry, isNew] = middles.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) addVertex(mesh, normalized(mesh.positions[a] + mesh.positions[b]));
    return entry->second;
  };
  std::vector<Triangle> fine;
  fine.reserve(mesh.triangles.size() * 4);
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    fine.insert(fine.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
  }
  mesh.triangles = std::move(fine);
}

// A point of the lattice on a box's surface, counted in cells.
using LatticePoint = std::array<int, 3>;

// One side of a box: the lattice axes u and v span it so that u x v points outwards, at the low or high end of `w`.
void addBoxSide(Mesh& mesh, std::map<LatticePoint, std::uint32_t>& known, Vec3d lo, Vec3d hi, std::array<int, 3> cells,
                std::array<std::size_t, 3> uvw, bool high) {
  const auto [u, v, w] = uvw;
  const auto vertexAt = [&](int i, int j) {
    LatticePoint at{};
    at[u] = i;
    at[v] = j;
    at[w] = high ? cells[w] : 0;
    const auto [entry, isNew] = known.try_emplace(at, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) {
      addVertex(mesh, {lo.x + (hi.x - lo.x) * at[0] / cells[0], lo.y + (hi.y - lo.y) * at[1] / cells[1],
                       lo.z + (hi.z - lo.z) * at[2] / cells[2]});
    }
    return entry->second;
  };
  for (int j = 0; j < cells[v]; ++j) {
    for (int i = 0; i < cells[u]; ++i) {
      const std::uint32_t a = vertexAt(i, j), b = vertexAt(i + 1, j), c = vertexAt(i + 1, j + 1),
                          d = vertexAt(i, j + 1);
      addQuad(mesh, a, b, c, d);
    }
  }
}

}  // namespace

double smoothNoise(Vec3d p) {
  double sum = 0, amplitude = 1;
  for (int octave = 0; octave < 4; ++octave) {
    sum += amplitude * std::sin(3.1 * p.x + 1.3 * p.y + 0.3) * std::sin(2.7 * p.y - 1.1 * p.z + 1.0) *
           std::sin(3.3 * p.z + 1.7 * p.x + 2.0);
    p *= 2.1;
    amplitude *= 0.5;
  }
  return sum;
}

Mesh grid(Vec3d o, Vec3d u, Vec3d v, int nu, int nv) {
  Mesh mesh;
  mesh.source = "grid";
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) addVertex(mesh, o + u * (double(i) / nu) + v * (double(j) / nv));
  }
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (nu + 1) + i), row = static_cast<std::uint32_t>(nu + 1);
      addQuad(mesh, a, a + 1, a + row + 1, a + row);
    }
  }
  return mesh;
}

Mesh box(Vec3d lo, Vec3d hi, std::array<int, 3> cells) {
  Mesh mesh;
  mesh.source = "box";
  std::map<LatticePoint, std::uint32_t> known;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    addBoxSide(mesh, known, lo, hi, cells, {v, u, axis}, false);
    addBoxSide(mesh, known, lo, hi, cells, {u, v, axis}, true);
  }
  return mesh;
}

Mesh cube() {
  Mesh mesh = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  mesh.source = "cube";
  return mesh;
}

Mesh cubeSplit() {
  const Mesh welded = cube();
  Mesh mesh;
  mesh.source = "cube with 24 vertices";
  // box() makes the two triangles of a quad one after the other: corners a, b, c of the first, then d of the second.
  for (std::size_t f = 0; f < welded.triangles.size(); f += 2) {
    const Triangle &first = welded.triangles[f], &second = welded.triangles[f + 1];
    const std::uint32_t a = addVertex(mesh, welded.positions[first[0]]);
    addVertex(mesh, welded.positions[first[1]]);
    addVertex(mesh, welded.positions[first[2]]);
    addVertex(mesh, welded.positions[second[2]]);
    addQuad(mesh, a, a + 1, a + 2, a + 3);
  }
  return mesh;
}

Mesh boxRoom(int n) {
  Mesh mesh = flipped(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {n, n, n}));
  mesh.source = "box room";
  return mesh;
}

Mesh icosphere(int level, double displacement) {
  Mesh mesh = icosahedron();
  for (int i = 0; i < level; ++i) subdivide(mesh);
  if (displacement != 0) {
    for (Vec3d& p : mesh.positions) p *= 1 + displacement * smoothNoise(p);
  }
  mesh.source = "icosphere " + std::to_string(level);
  return mesh;
}

Mesh inwardSphere(int level, double displacement) {
  Mesh mesh = flipped(icosphere(level, displacement));
  mesh.source = "inward sphere " + std::to_string(level);
  return mesh;
}

Mesh bowl(double aperture, int rings, int sectors, bool normals) {
  Mesh mesh;
  mesh.source = "bowl";
  for (int r = 0; r < rings; ++r) {
    const double theta = aperture + (std::numbers::pi - aperture) * r / rings;
    for (int s = 0; s < sectors; ++s) {
      const double phi = 2 * std::numbers::pi * s / sectors;
      addVertex(mesh, {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  const std::uint32_t pole = addVertex(mesh, {0, 0, -1});
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      const auto a = static_cast<std::uint32_t>(r * sectors + s);
      const auto b = static_cast<std::uint32_t>(r * sectors + (s + 1) % sectors),
                 down = static_cast<std::uint32_t>(sectors);
      if (r + 1 < rings) {
        addQuad(mesh, a, b, b + down, a + down);
      } else {
        mesh.triangles.push_back({a, b, pole});
      }
    }
  }
  if (normals) {
    for (const Vec3d& p : mesh.positions) mesh.vertexNormals.push_back(Vec3f(-p));
  }
  return mesh;
}

Mesh openCavity(int level, double displacement, double holeDegrees) {
  // The hole is cut by the undisplaced sphere's faces, so that its rim does not depend on the displacement.
  const Mesh plain = icosphere(level);
  Mesh mesh = inwardSphere(level, displacement);
  const double cosHole = std::cos(holeDegrees * std::numbers::pi / 180);
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d middle = plain.positions[t[0]] + plain.positions[t[1]] + plain.positions[t[2]];
    if (normalized(middle).z < cosHole) kept.push_back(t);
  }
  mesh.triangles = std::move(kept);
  mesh = compacted(mesh);
  mesh.source = "open cavity";
  return mesh;
}

Mesh corner(int n) {
  Mesh mesh;
  mesh.source = "corner of three squares";
  std::map<LatticePoint, std::uint32_t> known;
  // The low sides of the unit box seen from inside; z = 0 first, so that vertex 0 is the corner.
  for (std::size_t axis : {2, 0, 1}) {
    addBoxSide(mesh, known, {0, 0, 0}, {1, 1, 1}, {n, n, n}, {(axis + 1) % 3, (axis + 2) % 3, axis}, false);
  }
  return mesh;
}

Mesh bicone(int n, double h) {
  Mesh mesh;
  mesh.source = "bicone";
  for (int i = 0; i < n; ++i) {
    const double phi = 2 * std::numbers::pi * i / n;
    addVertex(mesh, {std::cos(phi), std::sin(phi), 0});
  }
  const std::uint32_t top = addVertex(mesh, {0, 0, h}), bottom = addVertex(mesh, {0, 0, -h});
  for (std::uint32_t i = 0; i < top; ++i) {
    const std::uint32_t j = (i + 1) % top;
    mesh.triangles.push_back({i, j, top});
    mesh.triangles.push_back({j, i, bottom});
  }
  return mesh;
}

Mesh tetrahedron() {
  Mesh mesh;
  mesh.source = "tetrahedron";
  for (Vec3d p : {Vec3d(1, 1, 1), Vec3d(1, -1, -1), Vec3d(-1, 1, -1), Vec3d(-1, -1, 1)}) addVertex(mesh, normalized(p));
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return mesh;
}

Mesh octahedron() {
  Mesh mesh = bicone(4, 1);
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.source = "octahedron";
  return mesh;
}

Mesh lathe(const std::vector<std::array<double, 2>>& profile, int sectors) {
  Mesh mesh;
  mesh.source = "lathe";
  const auto n = static_cast<std::uint32_t>(sectors);
  for (const auto& [radius, z] : profile) {
    for (int s = 0; s < sectors; ++s) {
      const double phi = 2 * std::numbers::pi * s / sectors;
      addVertex(mesh, {radius * std::cos(phi), radius * std::sin(phi), z});
    }
  }
  const std::uint32_t bottom = addVertex(mesh, {0, 0, profile.front()[1]}),
                      top = addVertex(mesh, {0, 0, profile.back()[1]});
  const auto last = static_cast<std::uint32_t>(profile.size() - 1) * n;
  for (std::uint32_t s = 0; s < n; ++s) {
    const std::uint32_t next = (s + 1) % n;
    for (std::uint32_t row = 0; row < last; row += n) addQuad(mesh, row + s, row + next, row + n + next, row + n + s);
    mesh.triangles.push_back({next, s, bottom});
    mesh.triangles.push_back({last + s, last + next, top});
  }
  return mesh;
}

std::vector<Mesh> convexSolids() {
  return {cube(), tetrahedron(), octahedron(), icosphere(0), icosphere(2), bicone(1024, 1e-3), bicone(12, 40)};
}

}  // namespace shbake::shapes
