// The edges of a mesh by position.
#include "mesh/flat_edges.h"

#include "mesh/position_welder.h"

namespace shbake {

EdgeTable edgeTableOf(const Mesh& mesh, Passes& passes) {
  EdgeTable table;
  std::vector<std::uint32_t> point;
  point.reserve(mesh.positions.size());
  PositionWelder welder(mesh.positions.size());
  passes.forEach(mesh.positions.size(), [&](std::size_t v) { point.push_back(welder.add(mesh.positions[v])); });
  table.points = welder.positions().size();
  table.faces.reserve(mesh.triangles.size());
  passes.forEach(mesh.triangles.size(), [&](std::size_t f) {
    const Triangle& t = mesh.triangles[f];
    table.faces.push_back({point[t[0]], point[t[1]], point[t[2]]});
  });
  const EdgeGroups groups(table.faces, table.points, passes);
  table.ofSide.assign(3 * table.faces.size(), EdgeTable::kNone);
  table.sides.reserve(3 * table.faces.size());
  table.starts.reserve(3 * table.faces.size() / 2 + 1);
  groups.forEach(passes, [&](std::span<const FaceSide> sides) {
    for (const FaceSide s : sides) table.ofSide[s.side] = static_cast<std::uint32_t>(table.size());
    table.sides.insert(table.sides.end(), sides.begin(), sides.end());
    table.starts.push_back(static_cast<std::uint32_t>(table.sides.size()));
  });
  return table;
}

}  // namespace shbake
