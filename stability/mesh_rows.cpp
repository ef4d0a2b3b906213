// Rows about defects of the file: edges and vertices that are no surface, inverted faces, faces without area.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sh/irradiance.h"
#include "stability/families.h"
#include "stability/sky_judge.h"
#include "support/shapes.h"

namespace shbake::stability {
namespace {

constexpr int kOrder = 3;

Vec3d faceNormal(const Mesh& mesh, const Triangle& t) {
  const Vec3d& a = mesh.positions[t[0]];
  return normalized(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
}

/// The sum of the unit normals of the faces around each vertex, as many tools compute it.
std::vector<Vec3d> averagedNormals(const Mesh& mesh) {
  std::vector<Vec3d> normals(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3d& a = mesh.positions[t[0]];
    const Vec3d n = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    for (const std::uint32_t v : t) normals[v] += n * (1 / length(n));
  }
  for (Vec3d& n : normals) n = n * (1 / length(n));
  return normals;
}

BakedMesh bake(const Mesh& mesh, const Bench& bench) {
  BakeMeshOptions options;
  options.albedo.uniform = {1, 1, 1};
  options.bake.kind = TransferKind::shadowed;
  options.bake.order = kOrder;
  options.bake.rays = 1024;
  return bakeMesh(mesh, {}, options, bench.parallel, bench.progress);
}

// ---- Where surfaces meet in more than they should.

/// Corners whose normal is not a unit vector on the front of their own face.
Count wrongCorners(const Mesh& mesh, const std::vector<Vec3d>& normals) {
  Count count;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d front = faceNormal(mesh, t);
    for (const std::uint32_t v : t) {
      count.add(!(std::abs(length(normals[v]) - 1) < 1e-6 && dot(normals[v], front) > 1e-6));
    }
  }
  return count;
}

Outcome measureNonManifold(const Bench& bench) {
  Outcome outcome;
  for (const Mesh& mesh : {shapes::threeFacesOnEdge(), shapes::bowTie(), shapes::conesTipToTip(),
                           shapes::moebiusStrip(), shapes::doubledSheet(4), shapes::duplicateFaces()}) {
    for (int i = 0; i < (bench.brief ? 1 : 4); ++i) {
      const Mesh turnedMesh = shapes::rotated(mesh, turned(i).rotation);
      outcome.naive += wrongCorners(turnedMesh, averagedNormals(turnedMesh));
      const Mesh baked = bake(turnedMesh, bench).mesh;
      outcome.own += wrongCorners(baked, {baked.vertexNormals.begin(), baked.vertexNormals.end()});
    }
  }
  return outcome;
}

Outcome measureNonManifoldSky(const Bench& bench) {
  std::vector<SkyCase> cases;
  for (const Mesh& mesh : {shapes::threeFacesOnEdge(), shapes::bowTie(), shapes::conesTipToTip(),
                           shapes::moebiusStrip(), shapes::doubledSheet(4), shapes::duplicateFaces()}) {
    for (int i = 0; i < (bench.brief ? 1 : 3); ++i) cases.push_back({mesh, turned(i), SelfHits::facesOfVertex, 40});
  }
  return judgeSkies(cases, bench);
}

// ---- Faces that are wound the wrong way.

/// One face in so many is inverted.
constexpr std::array kFlipEvery{2, 3, 5, 20};

/// Corners of a convex mesh around the origin whose transfer is not that of an open point that faces outwards.
template <class TransferOf>
Count wrongOutside(const Mesh& mesh, const std::vector<Vec3d>& trueNormals, const TransferOf& transferOf) {
  Count count;
  std::vector<double> truth(kOrder * kOrder);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      sh::unshadowedTransfer(kOrder, trueNormals[v], 1, truth);
      double sum = 0;
      const auto values = transferOf(v);
      for (std::size_t i = 0; i < truth.size(); ++i) sum += std::pow(static_cast<double>(values[i]) - truth[i], 2);
      count.add(!(std::sqrt(sum) <= kNoticeable * sh::unshadowedNorm(kOrder)));
    }
  }
  return count;
}

Outcome measureInverted(const Bench& bench) {
  Outcome outcome;
  for (const int every : kFlipEvery) {
    Mesh mesh = shapes::flippedFaces(bench.brief ? 2 : 3, every);
    for (const Vec3d& p : mesh.positions) mesh.vertexNormals.emplace_back(p);
    const BakedMesh baked = bake(mesh, bench);
    std::vector<Vec3d> outwards;
    for (const Vec3d& p : baked.mesh.positions) outwards.push_back(normalized(p));
    outcome.own += wrongOutside(baked.mesh, outwards, [&](std::uint32_t v) { return baked.transfer.at(v, 0); });
    const std::vector<Vec3d> normals = averagedNormals(mesh);
    outcome.naive += wrongOutside(mesh, outwards, [&](std::uint32_t v) {
      // The convex mesh is dark where the normal points into it.
      std::vector<double> t(kOrder * kOrder);
      if (dot(normals[v], outwards[v]) > 0) sh::unshadowedTransfer(kOrder, normals[v], 1, t);
      return t;
    });
  }
  return outcome;
}

/// Edges of a mesh around the origin between a face that looks outwards and one that looks inwards.
std::size_t edgesOfInvertedFaces(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;  // outwards less inwards
  for (const Triangle& t : mesh.triangles) {
    const int side = dot(faceNormal(mesh, t), mesh.positions[t[0]]) > 0 ? 1 : -1;
    for (std::size_t k = 0; k < 3; ++k) sides[std::minmax(t[k], t[(k + 1) % 3])] += side;
  }
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const auto& edge) { return edge.second == 0; }));
}

/// Which side is meant nothing in such a file tells, but that it contradicts itself is there to be told, edge by edge.
Outcome measureInvertedAlone(const Bench& bench) {
  Outcome outcome;
  for (const int every : kFlipEvery) {
    const Mesh mesh = shapes::flippedFaces(bench.brief ? 2 : 3, every);
    const std::size_t truth = edgesOfInvertedFaces(mesh);
    const MeshCheck check = checkMesh(mesh, bench.progress);
    const std::size_t found = describeFindings(check).empty() ? 0 : check.flippedEdges.count;
    outcome.naive += {truth, truth};
    outcome.own += {truth, std::max(truth, found) - std::min(truth, found)};
  }
  return outcome;
}

// ---- Faces without area.

/// A flat floor in which each diagonal is mended by a triangle without area, as tools close T-junctions; turned, so
/// that rounding to float gives these triangles areas and normals by chance.
Mesh mendedFloor(int n, int turn) {
  const Mesh floor = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, n, n);
  Mesh mesh;
  mesh.source = "mended floor";
  mesh.positions = floor.positions;
  for (std::size_t f = 0; f < floor.triangles.size(); f += 2) {
    const auto [a, b, c] = floor.triangles[f];
    const auto m = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(floor.positions[a] * 0.7 + floor.positions[c] * 0.3);
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, m}, {m, b, c}, {a, m, c}, floor.triangles[f + 1]});
  }
  mesh = shapes::rotated(std::move(mesh), turned(turn).rotation);
  for (Vec3d& p : mesh.positions) p = roundedToFloat(p);
  return mesh;
}

Outcome measureNoArea(const Bench& bench) {
  Outcome outcome;
  // One degree changes the light of a facing sun by 1.7 %.
  const double least = std::cos(3.14159265358979 / 180);
  for (int i = 0; i < (bench.brief ? 2 : 8); ++i) {
    const Mesh mesh = mendedFloor(8, i);
    const Vec3d up = shapes::apply(turned(i).rotation, {0, 0, 1});
    for (const Vec3d& n : averagedNormals(mesh)) outcome.naive.add(!(dot(n, up) >= least));
    for (const Vec3f& n : bake(mesh, bench).mesh.vertexNormals) outcome.own.add(!(dot(Vec3d(n), up) >= least));
  }
  return outcome;
}

constexpr Row kRows[] = {
    {"non-manifold-normals", "meshes", "normals at non-manifold edges, bow-ties and doubled sheets",
     "black fans, or faces lit from behind", "the sum of the normals of the faces around a vertex",
     "a normal for each fan of faces that hangs together", "--normals, --crease",
     "a corner fails when its normal is no unit vector on the front of its face", 0, measureNonManifold},
    {"non-manifold-light", "meshes", "light at non-manifold edges, bow-ties and doubled sheets",
     "light through the edge where three faces meet", "faces that have the vertex as a corner do not count",
     "all faces at the position block, whatever their connections", "none: always on",
     "a vertex fails when its transfer is off by 2 % of an open point's", 0, measureNonManifoldSky},
    {"inverted", "meshes", "inverted faces in a file with normals", "dark triangles, scattered over the mesh",
     "normals from the winding", "the file's normals decide; faces that contradict them are turned", "--normals auto",
     "a corner of a convex mesh fails when its transfer is off by 2 % of an open point's", 0, measureInverted},
    {"inverted-alone", "meshes", "inverted faces in a file without normals", "dark triangles, scattered over the mesh",
     "baked without a word", "info counts each edge where two faces contradict each other, and says what follows",
     "info; mend the winding or write normals",
     "an edge between an inverted face and one that is not fails when info does not count it", 0, measureInvertedAlone},
    {"no-area", "meshes", "triangles without area, which rounding gives a normal", "smudges on a flat floor",
     "the sum of the normals of the faces around a vertex",
     "weighted by angle; faces so flat that rounding decides their normal have no say", "--normals smooth",
     "a vertex fails when its normal is off by 1 degree", 0, measureNoArea},
};

}  // namespace

std::span<const Row> meshRows() {
  return kRows;
}

}  // namespace shbake::stability
