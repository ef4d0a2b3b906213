// Welding by record. The idea of keeping a merge record beside an untouched mesh is that of the Manifold library's
// MeshGL (Lalish); the order along the curve is Morton, "A computer oriented geodetic data base", IBM 1966.
#include "mesh/weld.h"

#include <algorithm>
#include <tuple>

namespace shbake {
namespace {

// Bits 0..20 of x moved to bits 0, 3, 6, ...
std::uint64_t spreadBits(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFull;
  x = (x | x << 16) & 0x001F0000FF0000FFull;
  x = (x | x << 8) & 0x100F00F00F00F00Full;
  x = (x | x << 4) & 0x10C30C30C30C30C3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

// The cell of a coordinate in -1..1 on a lattice of 2^21 cells.
std::uint64_t cellOf(float coordinate) {
  const double cell = (static_cast<double>(coordinate) + 1) * 0x1p20;
  return static_cast<std::uint64_t>(std::clamp(cell, 0.0, 0x1p21 - 1));
}

std::uint64_t mortonCode(Vec3f p) {
  return spreadBits(cellOf(p.x)) | spreadBits(cellOf(p.y)) << 1 | spreadBits(cellOf(p.z)) << 2;
}

struct CodedVertex {
  std::uint64_t code;
  std::uint32_t vertex;
};

}  // namespace

Weld weldPositions(const Mesh& mesh, const WorkFrame& frame, Passes& passes) {
  Weld weld;
  weld.ofVertex.assign(mesh.positions.size(), Weld::kUnused);
  std::vector<Vec3f> work(mesh.positions.size());
  std::vector<CodedVertex> order;
  order.reserve(mesh.positions.size());
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      if (weld.ofVertex[v] != Weld::kUnused) continue;
      weld.ofVertex[v] = 0;
      work[v] = frame.toWork(mesh.positions[v]);
      order.push_back({mortonCode(work[v]), v});
    }
  });

  // Positions of one cell follow each other by coordinate, so that equal ones are neighbours and the order is complete.
  passes.sort(order.begin(), order.end(), [&work](const CodedVertex& a, const CodedVertex& b) {
    const Vec3f &p = work[a.vertex], &q = work[b.vertex];
    return std::tie(a.code, p.x, p.y, p.z) < std::tie(b.code, q.x, q.y, q.z);
  });
  passes.forEach(order.size(), [&](std::size_t i) {
    const CodedVertex& item = order[i];
    const Vec3f& p = work[item.vertex];
    if (weld.positions.empty() || !(weld.positions.back() == p)) weld.positions.push_back(p);
    weld.ofVertex[item.vertex] = static_cast<std::uint32_t>(weld.positions.size() - 1);
  });
  weld.positions.emplace_back();
  weld.positions.shrink_to_fit();
  weld.positions.pop_back();
  return weld;
}

}  // namespace shbake
