#include "scenes.h"

#include <filesystem>
#include <map>
#include <numbers>

#include "base/error.h"
#include "mesh/mesh_reader.h"
#include "support/shapes.h"

namespace shbake::bench {
namespace {

const std::map<std::string, Mesh (*)()>& generated() {
  static const std::map<std::string, Mesh (*)()> meshes = {
      {"city", [] { return shapes::city(16, 8, 8); }},
      {"citycoarse", [] { return shapes::city(16, 2, 2); }},
      {"cavity4", [] { return shapes::openCavity(4, 0.08, 25); }},
      {"cavity6", [] { return shapes::openCavity(6, 0.08, 25); }},
      {"bowl", [] { return shapes::bowl(std::numbers::pi / 6, 60, 96); }},
      {"blob5", [] { return shapes::icosphere(5, 0.25); }},
      {"cornell", [] { return shapes::cornellRoom(12); }},
      {"chess", [] { return shapes::chessPiece(4); }},
      {"sphere9", [] { return shapes::icosphere(9, 0.25); }},
  };
  return meshes;
}

}  // namespace

Mesh namedMesh(const std::string& name) {
  const auto known = generated().find(name);
  if (known != generated().end()) return known->second();
  if (!std::filesystem::exists(name)) {
    std::string names;
    for (const auto& [key, make] : generated()) names += " " + key;
    throw usageError("there is no file " + name + " and no generated mesh of that name", "generated are:" + names);
  }
  Progress progress;
  return readMesh(name, progress);
}

LightingPoints namedPoints(const std::string& name, const Rgb& albedo) {
  Albedo uniform;
  uniform.values = {albedo};
  Progress progress;
  return makeLightingPoints(namedMesh(name), {}, uniform, progress);
}

std::string labelOf(const std::string& name) {
  return name.substr(name.rfind('/') + 1);
}

std::vector<std::string> defaultMeshes(const std::string& folder) {
  std::vector<std::string> names{"city", "citycoarse", "cavity4", "blob5", "cornell"};
  for (const char* file : {"stanford-bunny.obj", "igl_armadillo.obj", "rocker-arm.obj", "fandisk.obj", "spot.obj",
                           "suzanne.obj", "teapot.obj", "cow.obj", "igl_decimated-knight.off", "igl_halftunnel.off"}) {
    const auto path = std::filesystem::path(folder) / file;
    if (std::filesystem::exists(path)) names.push_back(path.string());
  }
  return names;
}

}  // namespace shbake::bench
