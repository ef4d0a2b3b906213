// Polygons of a file, added to a mesh as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace shbake {

/// Adds the polygons of a file to Mesh::triangles, and to Mesh::sourcePolygons as soon as one is not a triangle.
class PolygonCollector {
 public:
  /// `mesh` must hold all positions before the first polygon is added.
  explicit PolygonCollector(Mesh& mesh) : mesh_(mesh) {}

  /// Adds one polygon, whose vertices are valid indices of positions. Returns its triangles as corner numbers of the
  /// polygon (valid until the next call): none when it has fewer than three corners. Throws an Error beyond 2^32 - 2
  /// triangles.
  std::span<const Triangle> add(std::span<const std::uint32_t> vertices);

  /// Polygons with fewer than three corners, which have no area and add no triangle.
  std::size_t withoutArea() const { return withoutArea_; }

 private:
  Mesh& mesh_;
  std::uint32_t polygons_ = 0;
  std::size_t withoutArea_ = 0;
  bool onlyTriangles_ = true;
  std::vector<Vec3d> corners_;
  std::vector<Triangle> cut_;
};

}  // namespace shbake
