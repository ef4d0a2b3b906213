#include "transfer/baked_albedo.h"

#include <algorithm>

#include "base/srgb.h"

namespace shbake {
namespace {

Rgb linearAlbedo(const Rgb& color, ColorEncoding encoding, bool bytesAreLinear) {
  const auto clampOne = [](float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; };
  const Rgb clamped(clampOne(color.x), clampOne(color.y), clampOne(color.z));
  return encoding == ColorEncoding::srgb && !bytesAreLinear ? srgbToLinear(clamped) : clamped;
}

}  // namespace

std::optional<std::vector<Rgb>> bakedAlbedo(const BakedPly& baked) {
  const Mesh& mesh = baked.mesh;
  const AlbedoFacts& facts = baked.facts.albedo;
  const std::size_t vertices = mesh.positions.size();
  if (!facts.included) return std::vector<Rgb>(vertices, Rgb(1, 1, 1));
  if (facts.origin == AlbedoOrigin::uniform) return std::vector<Rgb>(vertices, facts.uniform);
  std::vector<Rgb> albedo(vertices);
  if (facts.origin == AlbedoOrigin::vertexColors && !mesh.vertexColors.empty()) {
    std::ranges::transform(mesh.vertexColors, albedo.begin(), [&](const Rgb& c) {
      return linearAlbedo(c, mesh.vertexColorEncoding, facts.bytesAreLinear);
    });
    return albedo;
  }
  if (facts.origin == AlbedoOrigin::faceColors && !mesh.faceColors.empty()) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const Rgb color = linearAlbedo(mesh.faceColors[f], mesh.faceColorEncoding, facts.bytesAreLinear);
      for (const std::uint32_t v : mesh.triangles[f]) albedo[v] = color;
    }
    return albedo;
  }
  return {};
}

}  // namespace shbake
