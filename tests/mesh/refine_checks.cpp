// What any refinement must keep.
#include "refine_checks.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/mesh_check.h"
#include "mesh/refine_attributes.h"

namespace shbake {
namespace {

Vec3d areaVector(const Mesh& mesh, std::size_t face) {
  const Triangle& t = mesh.triangles[face];
  const Vec3d a = mesh.positions[t[0]];
  return cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a) * 0.5;
}

double magnitude(const Mesh& mesh, std::size_t face) {
  double most = 0;
  for (const std::uint32_t v : mesh.triangles[face]) {
    const Vec3d& p = mesh.positions[v];
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return most;
}

/// The lengths of edges with one face, and of those with three or more, by position.
std::array<double, 2> oddEdges(const Mesh& mesh) {
  using Place = std::array<double, 3>;
  std::map<std::pair<Place, Place>, int> count;
  const auto placeOf = [&](std::uint32_t v) {
    return Place{mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z};
  };
  for (const Triangle& t : mesh.triangles) {
    const std::array<Place, 3> p{placeOf(t[0]), placeOf(t[1]), placeOf(t[2])};
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) ++count[std::minmax(p[k], p[(k + 1) % 3])];
  }
  std::array<double, 2> sums{};
  for (const auto& [ends, faces] : count) {
    const auto& [a, b] = ends;
    const double size = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    if (faces == 1) sums[0] += size;
    if (faces > 2) sums[1] += size * faces;
  }
  return sums;
}

/// The area of faces that have the positions of another one.
double doubledArea(const Mesh& mesh) {
  std::map<std::array<std::array<double, 3>, 3>, std::pair<int, double>> faces;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& p = mesh.positions[mesh.triangles[f][k]];
      corners[k] = {p.x, p.y, p.z};
    }
    std::sort(corners.begin(), corners.end());
    auto& [count, area] = faces[corners];
    ++count;
    area += length(areaVector(mesh, f));
  }
  double sum = 0;
  for (const auto& [corners, found] : faces) sum += found.first > 1 ? found.second : 0;
  return sum;
}

}  // namespace

RefinedMesh refinedBy(const Mesh& mesh, const EdgeLength& length, int threads) {
  Progress progress;
  return refineFlatRegions(mesh, {}, length, Parallel(threads), progress);
}

Mesh inFloats(Mesh mesh) {
  for (Vec3d& p : mesh.positions) p = roundedToFloat(p);
  return mesh;
}

RefinedMesh refinedTo(const Mesh& mesh, double length, const RefineOptions& options) {
  Progress progress;
  const Parallel parallel(2);
  return refineFlatRegions(
      mesh, options, [length](std::uint32_t, const Vec3d&) { return length; }, parallel, progress);
}

double areaOf(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) sum += length(areaVector(mesh, f));
  return sum;
}

double volumeOf(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])) / 6;
  }
  return sum;
}

void checkKept(const Mesh& before, const RefinedMesh& after) {
  const Mesh& mesh = after.mesh;
  REQUIRE(mesh.positions.size() >= before.positions.size());
  CHECK(std::equal(before.positions.begin(), before.positions.end(), mesh.positions.begin()));
  REQUIRE(after.sourceFace.size() == mesh.triangles.size());
  CHECK(std::is_sorted(after.sourceFace.begin(), after.sourceFace.end()));

  const auto isStored = [&](const Vec3d& p) {
    return mesh.doublePositions ||
           (static_cast<float>(p.x) == p.x && static_cast<float>(p.y) == p.y && static_cast<float>(p.z) == p.z);
  };
  CHECK(std::all_of(mesh.positions.begin() + static_cast<std::ptrdiff_t>(before.positions.size()), mesh.positions.end(),
                    isStored));

  // Positions that rounding moved make borders longer by less than the square of an ulp over a side, or, where a side
  // is hardly longer, an ulp.
  const std::array<double, 2> odd = oddEdges(before), oddAfter = oddEdges(mesh);
  CHECK(oddAfter[0] == Approx(odd[0]).epsilon(1e-6));
  Progress progress;
  const MeshCheck check = checkMesh(before, progress), checkAfter = checkMesh(mesh, progress);
  CHECK(checkAfter.parts == check.parts);
  CHECK(checkAfter.closedParts == check.closedParts);
  CHECK(checkAfter.degenerateFaces.count == check.degenerateFaces.count);
  CHECK(doubledArea(mesh) == Approx(doubledArea(before)).margin(1e-6 * areaOf(before)));
  // New edges inside doubled faces have four faces, too.
  if (check.duplicateFaces.count == 0) CHECK(oddAfter[1] == Approx(odd[1]).epsilon(1e-6));
  CHECK(checkAfter.isolatedVertices.count == check.isolatedVertices.count);
  CHECK(checkAfter.eulerCharacteristic == check.eulerCharacteristic);

  // Faces of a patch have their corners within 4 ulps of its plane, new points within one more; a face's own plane
  // carries the errors of its corners on, by their weights at the point.
  const double epsilon = mesh.doublePositions ? 0x1p-52 : 0x1p-23;
  double excess = 0;
  bool turned = false;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::uint32_t source = after.sourceFace[f];
    if (mesh.triangles[f] == before.triangles[source]) continue;
    const Vec3d normal = normalized(areaVector(before, source));
    turned = turned || !(dot(normal, areaVector(mesh, f)) > 0);
    std::array<Vec3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = before.positions[before.triangles[source][k]];
    for (const std::uint32_t v : mesh.triangles[f]) {
      const Blend at = blendAt(corners, mesh.positions[v]);
      const double carried = std::abs(1 - at.weightB - at.weightC) + std::abs(at.weightB) + std::abs(at.weightC);
      const double height = std::abs(dot(normal, mesh.positions[v] - corners[0]));
      excess = std::max(excess, height / (epsilon * magnitude(before, source)) - 4 * carried - 5);
    }
  }
  CHECK_FALSE(turned);
  CHECK(excess <= 0);
  CHECK(after.report.area[0] == Approx(areaOf(before)).epsilon(1e-12));
  CHECK(after.report.area[1] == Approx(areaOf(mesh)).epsilon(1e-12));
  CHECK(after.report.vertices == std::array{before.positions.size(), mesh.positions.size()});
  CHECK(after.report.faces == std::array{before.triangles.size(), mesh.triangles.size()});
}

std::vector<double> newSides(const Mesh& before, const RefinedMesh& after) {
  std::vector<double> sides;
  for (std::size_t f = 0; f < after.mesh.triangles.size(); ++f) {
    const Triangle& t = after.mesh.triangles[f];
    if (t == before.triangles[after.sourceFace[f]]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      sides.push_back(length(after.mesh.positions[t[k]] - after.mesh.positions[t[(k + 1) % 3]]));
    }
  }
  return sides;
}

bool sameMesh(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.triangles == b.triangles && a.doublePositions == b.doublePositions &&
         a.vertexNormals == b.vertexNormals && a.cornerNormals == b.cornerNormals && a.vertexColors == b.vertexColors &&
         a.faceColors == b.faceColors && a.sourcePolygons == b.sourcePolygons &&
         a.vertexProperties == b.vertexProperties && a.faceProperties == b.faceProperties && a.elements == b.elements &&
         a.comments == b.comments;
}

}  // namespace shbake
