#include "mesh/polygon_collector.h"

#include <limits>
#include <numeric>

#include "base/error.h"
#include "mesh/polygon_triangulation.h"

namespace shbake {

std::span<const Triangle> PolygonCollector::add(std::span<const std::uint32_t> vertices) {
  static constexpr Triangle kWhole[] = {{0, 1, 2}};
  std::span<const Triangle> cut = kWhole;
  if (vertices.size() != 3) {
    if (onlyTriangles_) {
      mesh_.sourcePolygons.resize(mesh_.triangles.size());
      std::iota(mesh_.sourcePolygons.begin(), mesh_.sourcePolygons.end(), 0u);
      onlyTriangles_ = false;
    }
    corners_.clear();
    for (const std::uint32_t v : vertices) corners_.push_back(mesh_.positions[v]);
    triangulatePolygon(corners_, cut_);
    cut = cut_;
    withoutArea_ += cut.empty();
  }
  if (mesh_.triangles.size() + cut.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(
        {.file = mesh_.source, .cause = "holds more than 4294967294 triangles", .remedy = "split the mesh into parts"});
  }
  for (const Triangle& t : cut) mesh_.triangles.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  if (!onlyTriangles_) mesh_.sourcePolygons.insert(mesh_.sourcePolygons.end(), cut.size(), polygons_);
  ++polygons_;
  return cut;
}

}  // namespace shbake
