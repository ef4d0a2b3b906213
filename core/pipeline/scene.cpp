#include "pipeline/scene.h"

#include <algorithm>
#include <cstdint>

namespace shbake {
namespace {

/// The albedos of a mesh as one value a face or vertex, whatever they were given for.
std::vector<Rgb> spread(const Mesh& mesh, const Albedo& albedo, Albedo::Per per) {
  if (albedo.per == per) return albedo.values;
  const std::size_t size = per == Albedo::Per::face ? mesh.triangles.size() : mesh.positions.size();
  if (albedo.per == Albedo::Per::mesh) return std::vector<Rgb>(size, albedo.values[0]);
  std::vector<Rgb> sum(size);
  std::vector<float> count(size, 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      const std::size_t to = per == Albedo::Per::face ? f : v;
      sum[to] += albedo.ofCorner(f, v);
      count[to] += 1;
    }
  }
  for (std::size_t i = 0; i < size; ++i) sum[i] = count[i] > 0 ? sum[i] * (1 / count[i]) : Rgb();
  return sum;
}

/// Appends normals of one mesh, or zeros ("none given here") where it has none of this kind.
void appendNormals(std::vector<Vec3f>& to, const std::vector<Vec3f>& from, std::size_t size) {
  to.insert(to.end(), from.begin(), from.end());
  to.resize(to.size() + size - from.size());
}

void append(Mesh& scene, const Mesh& part, bool cornerNormals) {
  const auto base = static_cast<std::uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), part.positions.begin(), part.positions.end());
  for (const Triangle& t : part.triangles) scene.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  if (!cornerNormals) return appendNormals(scene.vertexNormals, part.vertexNormals, part.positions.size());
  if (!part.cornerNormals.empty() || part.vertexNormals.empty()) {
    return appendNormals(scene.cornerNormals, part.cornerNormals, 3 * part.triangles.size());
  }
  for (const Triangle& t : part.triangles) {
    for (const std::uint32_t v : t) scene.cornerNormals.push_back(part.vertexNormals[v]);
  }
}

}  // namespace

Scene joinScene(const Mesh& mesh, const Albedo& albedo, const std::vector<Mesh>& blockers,
                const std::vector<Albedo>& blockerAlbedos) {
  std::vector<const Mesh*> parts{&mesh};
  std::vector<const Albedo*> albedos{&albedo};
  for (const Mesh& b : blockers) parts.push_back(&b);
  for (const Albedo& a : blockerAlbedos) albedos.push_back(&a);

  Scene scene;
  scene.mesh.source = mesh.source;
  const bool cornerNormals = std::any_of(parts.begin(), parts.end(), [](auto* m) { return !m->cornerNormals.empty(); });
  for (const Mesh* part : parts) append(scene.mesh, *part, cornerNormals);

  Albedo::Per per = albedo.per;
  for (const Albedo* a : albedos) per = per == Albedo::Per::mesh ? a->per : per;
  const bool oneValue = per == Albedo::Per::mesh && std::all_of(albedos.begin(), albedos.end(), [&](const Albedo* a) {
                          return a->values[0] == albedo.values[0];
                        });
  if (oneValue) {
    scene.albedo = albedo;
    return scene;
  }
  scene.albedo.per = per == Albedo::Per::mesh ? Albedo::Per::face : per;
  scene.albedo.values.clear();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::vector<Rgb> values = spread(*parts[i], *albedos[i], scene.albedo.per);
    scene.albedo.values.insert(scene.albedo.values.end(), values.begin(), values.end());
  }
  return scene;
}

}  // namespace shbake
