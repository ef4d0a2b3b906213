// A baked mesh and its ground plane.
#include "cli/baked_scene.h"

#include <filesystem>
#include <utility>

#include "cli/verb.h"

namespace shbake::cli {
namespace {

/// Rays a point of the plane: its even grey shows noise that a mesh of many forms and colours hides.
constexpr int kGroundRays = 512;

/// The mesh as it shades and reflects: its albedo as vertex colours.
Mesh blockerOf(const BakedPly& baked, const std::string& path, Session& session) {
  Mesh blocker;
  blocker.source = path;
  blocker.positions = baked.mesh.positions;
  blocker.triangles = baked.mesh.triangles;
  blocker.vertexNormals = baked.mesh.vertexNormals;
  const std::optional<std::vector<Rgb>> albedo = bakedAlbedo(baked);
  if (!albedo && baked.facts.kind == TransferKind::interreflected) {
    session.warn(path + ": the albedo behind it is not known; on the ground it reflects as grey 0.8");
  }
  blocker.vertexColors = albedo.value_or(std::vector<Rgb>(blocker.positions.size(), AlbedoOptions{}.uniform));
  blocker.vertexColorEncoding = ColorEncoding::linear;
  return blocker;
}

}  // namespace

BakedScene::BakedScene(const std::string& path, Session& session)
    : path_(path), baked_(readBakedPly(path, session.progress)) {
  for (const std::string& note : baked_.notes) session.warn(path + ": " + note);
}

void BakedScene::addGround(const Rgb& albedo, UpAxis up, Session& session) {
  BakeMeshOptions options;
  options.bake.kind = baked_.facts.kind;
  options.bake.order = baked_.transfer.order;
  options.bake.rays = kGroundRays;
  options.albedo.source = AlbedoSource::uniform;
  options.albedo.uniform = albedo;
  ground_ = bakeMesh(groundPlane(baked_.mesh.positions, up), {blockerOf(baked_, path_, session)}, options,
                     session.parallel, session.progress);
  for (const std::string& sentence : ground_->warnings) session.warn("ground plane: " + sentence);
}

std::string BakedScene::title() const {
  return baked_.stated ? transferName(baked_.facts.kind) : std::filesystem::path(path_).stem().string();
}

std::vector<Rgb> BakedScene::colors(const ViewLight& light, const Parallel& parallel) const {
  return light.colors(baked_.transfer, baked_.mesh.positions, {}, parallel);
}

BakedScene::Drawn BakedScene::drawn(const ViewLight& light, const Camera& camera, const Parallel& parallel) const {
  Drawn drawn;
  drawn.mesh.positions = baked_.mesh.positions;
  drawn.mesh.triangles = baked_.mesh.triangles;
  drawn.colors = colors(light, parallel);
  const bool above = ground_ && dot(Vec3d(ground_->mesh.vertexNormals[0]), camera.eye - ground_->mesh.positions[0]) > 0;
  if (!above) return drawn;
  const Mesh& plane = ground_->mesh;
  const auto first = static_cast<std::uint32_t>(drawn.mesh.positions.size());
  drawn.mesh.positions.insert(drawn.mesh.positions.end(), plane.positions.begin(), plane.positions.end());
  for (const Triangle& t : plane.triangles) {
    drawn.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const std::vector<Rgb> colors = light.colors(ground_->transfer, plane.positions, {}, parallel);
  drawn.colors.insert(drawn.colors.end(), colors.begin(), colors.end());
  return drawn;
}

}  // namespace shbake::cli
