// Which material each triangle of an OBJ file has, and what a mesh keeps of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/progress.h"
#include "mesh/mesh.h"
#include "mesh/obj_materials.h"

namespace shbake {

/// Follows the `mtllib` and `usemtl` statements of an OBJ file.
class ObjMaterialUse {
 public:
  /// The argument of a `mtllib`: one file name, or several between blanks.
  void addLibrary(std::string_view names) { libraries_.emplace_back(names); }
  /// A `usemtl`: the material of all triangles from here on.
  void use(std::string_view name);
  /// Counts triangles that have just been added to the mesh.
  void addTriangles(std::size_t count);

  /// Reads the libraries, which stand beside `mesh.source`, and adds to the mesh what materials say: faceColors where a
  /// material in use has a Kd, comments "TextureFile NAME" and, for several textures, the face property `texnumber`.
  /// Missing files and materials add warnings.
  void settle(Mesh& mesh, Progress& progress) const;

 private:
  std::vector<ObjMaterial> readLibraries(Mesh& mesh, Progress& progress) const;
  std::vector<ObjMaterial> findUsed(const std::vector<ObjMaterial>& all, Mesh& mesh) const;
  void addColors(const std::vector<ObjMaterial>& used, Mesh& mesh) const;
  void addTextures(const std::vector<ObjMaterial>& used, Mesh& mesh) const;

  std::vector<std::string> libraries_;
  std::vector<std::string> names_;  // in the order of their first use
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::uint32_t current_ = ~0u;
  std::size_t triangles_ = 0;
  std::vector<std::uint32_t> ofTriangle_;  // numbers into names_ or ~0; empty before the first usemtl
};

}  // namespace shbake
