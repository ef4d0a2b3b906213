// The loop of MeshLab's filter_embree, given SH sums: from the centre of each face, nearest-hit rays along those
// directions of a Fibonacci sphere that rise above the face, beginning at 1e-5 of the file's units; then each vertex
// takes the mean of its faces. The mean respects creases here, which MeshLab's does not.
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "chart/methods/sphere_table.h"
#include "chart/methods/table_method.h"
#include "sh/basis.h"

namespace shbake::chart {
namespace {

constexpr double kNear = 1e-5;  // file units

/// The seed turns the lattice about z; MeshLab's own is always the same.
std::vector<Vec3d> fibonacciSphere(int n, std::uint64_t seed) {
  std::vector<Vec3d> all;
  for (int i = 0; i < n; ++i) {
    const double turn = i * (std::numbers::phi - 1) + hashUnit(seed, 0);
    all.push_back(sphereDirection((i + 0.5) / n, turn - std::floor(turn)));
  }
  return all;
}

/// The faces that have a chosen point as a corner, each once, and those of each point.
struct FacesOfPoints {
  std::vector<std::uint32_t> faces;
  std::vector<std::vector<std::uint32_t>> ofPoint;  // indices into `faces`
};

FacesOfPoints facesOf(const LightingPoints& points, std::span<const std::uint32_t> chosen) {
  FacesOfPoints result;
  result.ofPoint.resize(chosen.size());
  std::vector<std::uint32_t> number(points.faces.size(), LightingPoints::kNone);
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    for (const std::uint32_t f : points.positionFaces[points.pointPosition[chosen[c]]]) {
      const Triangle& corners = points.facePoints[f];
      if (corners[0] != chosen[c] && corners[1] != chosen[c] && corners[2] != chosen[c]) continue;
      if (number[f] == LightingPoints::kNone) {
        number[f] = static_cast<std::uint32_t>(result.faces.size());
        result.faces.push_back(f);
      }
      result.ofPoint[c].push_back(number[f]);
    }
  }
  return result;
}

}  // namespace

Estimate estimateMeshLab(const TestBed& bed, const Task& task, Progress& progress) {
  const LightingPoints& points = bed.points();
  const SphereTable table(fibonacciSphere(task.rays, task.seed), task.order);
  const FacesOfPoints near = facesOf(points, task.chosen);
  const auto begin = static_cast<float>(kNear * points.frame.scale);
  const RTCScene scene = bed.bare().scene();
  const auto count = static_cast<std::size_t>(sh::coefficientCount(task.order));
  std::vector<float> ofFaces(near.faces.size() * count);
  SphereSum sum(table);
  Estimate result;
  const double cpu = timedOverPoints(near.faces, progress, [&](std::uint32_t f, std::size_t i) {
    const Triangle& t = points.faces[f];
    const Vec3f a = points.positions[t[0]], b = points.positions[t[1]], c = points.positions[t[2]];
    const Vec3f normal = normalized(cross(b - a, c - a)), centre = (a + b + c) * (1.0f / 3);
    sum.clear();
    for (std::size_t d = 0; d < table.size(); ++d) {
      const float h = dot(table.direction(d), normal);
      if (h <= 0) continue;
      result.rays += 1;
      if (!hasHit(scene, rayFrom(centre, begin, table.direction(d), 0))) sum.add(d, h);
    }
    sum.finish(4.0 / task.rays, {&ofFaces[i * count], count});
  });
  result.transfer.assign(task.chosen.size() * count, 0);
  for (std::size_t c = 0; c < task.chosen.size(); ++c) {
    const auto share = 1 / static_cast<float>(near.ofPoint[c].size());
    for (const std::uint32_t i : near.ofPoint[c]) {
      for (std::size_t k = 0; k < count; ++k) result.transfer[c * count + k] += share * ofFaces[i * count + k];
    }
  }
  const double perFace = static_cast<double>(points.faces.size()) / static_cast<double>(near.faces.size());
  result.cpu = cpu * perFace;
  result.rays *= perFace / static_cast<double>(points.size());
  return result;
}

}  // namespace shbake::chart
