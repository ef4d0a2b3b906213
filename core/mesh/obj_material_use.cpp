#include "mesh/obj_material_use.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "base/error.h"
#include "mesh/column.h"
#include "mesh/text_colors.h"

namespace shbake {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kNone = ~0u;

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The files that a `mtllib` names, beside the OBJ file. A name may hold blanks, so all of the argument is tried first.
std::vector<fs::path> libraryPaths(const fs::path& folder, std::string names) {
  std::replace(names.begin(), names.end(), '\\', '/');
  if (isFile(folder / names)) return {folder / names};
  std::vector<fs::path> paths;
  std::istringstream words(names);
  for (std::string word; words >> word;) paths.push_back(folder / word);
  return paths;
}

}  // namespace

void ObjMaterialUse::use(std::string_view name) {
  const auto [entry, added] = numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(names_.size()));
  if (added) names_.emplace_back(name);
  current_ = entry->second;
}

void ObjMaterialUse::addTriangles(std::size_t count) {
  if (current_ != kNone) {
    ofTriangle_.resize(triangles_, kNone);
    ofTriangle_.insert(ofTriangle_.end(), count, current_);
  }
  triangles_ += count;
}

void ObjMaterialUse::settle(Mesh& mesh, Progress& progress) const {
  if (ofTriangle_.empty()) return;
  const std::vector<ObjMaterial> used = findUsed(readLibraries(mesh, progress), mesh);
  addColors(used, mesh);
  addTextures(used, mesh);
}

std::vector<ObjMaterial> ObjMaterialUse::readLibraries(Mesh& mesh, Progress& progress) const {
  std::vector<ObjMaterial> all;
  for (const std::string& names : libraries_) {
    for (const fs::path& path : libraryPaths(fs::path(mesh.source).parent_path(), names)) {
      try {
        const auto materials = readObjMaterials(path.string(), progress, mesh.warnings);
        all.insert(all.end(), materials.begin(), materials.end());
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) throw;
        mesh.warnings.push_back("material file left out: " + std::string(error.what()));
      }
    }
  }
  return all;
}

std::vector<ObjMaterial> ObjMaterialUse::findUsed(const std::vector<ObjMaterial>& all, Mesh& mesh) const {
  std::vector<ObjMaterial> used;
  std::size_t missing = 0;
  std::string firstMissing;
  for (const std::string& name : names_) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const ObjMaterial& m) { return m.name == name; });
    used.push_back(found == all.end() ? ObjMaterial{} : *found);
    if (found == all.end() && missing++ == 0) firstMissing = name;
  }
  // Without any material file the warning about that file, or the lack of a mtllib, has said enough.
  if (missing > 0 && !all.empty()) {
    mesh.warnings.push_back(std::to_string(missing) + " materials are in no material file (the first is \"" +
                            firstMissing + "\")");
  }
  return used;
}

void ObjMaterialUse::addColors(const std::vector<ObjMaterial>& used, Mesh& mesh) const {
  if (std::none_of(used.begin(), used.end(), [](const ObjMaterial& m) { return m.hasDiffuse; })) return;
  for (const std::uint32_t m : ofTriangle_) {
    mesh.faceColors.push_back(m != kNone && used[m].hasDiffuse ? used[m].diffuse : kNoColor);
  }
  mesh.faceColorEncoding = settleTextColors(mesh.faceColors, "face colours", mesh.warnings);
}

void ObjMaterialUse::addTextures(const std::vector<ObjMaterial>& used, Mesh& mesh) const {
  std::vector<std::string> textures;
  std::vector<std::int32_t> textureOf;  // of each used material
  for (const ObjMaterial& m : used) {
    const auto known = std::find(textures.begin(), textures.end(), m.texture);
    textureOf.push_back(m.texture.empty() ? -1 : static_cast<std::int32_t>(known - textures.begin()));
    if (!m.texture.empty() && known == textures.end()) textures.push_back(m.texture);
  }
  for (const std::string& texture : textures) mesh.comments.push_back("TextureFile " + texture);
  if (textures.size() < 2) return;
  std::vector<std::int32_t> numbers;
  for (const std::uint32_t m : ofTriangle_) numbers.push_back(m == kNone ? -1 : textureOf[m]);
  mesh.faceProperties.push_back(scalarColumn("texnumber", numbers));
}

}  // namespace shbake
