#include "pipeline/albedo.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/srgb.h"

namespace shbake {
namespace {

bool inRange(const Rgb& c) {
  return c.x >= 0 && c.x <= 1 && c.y >= 0 && c.y <= 1 && c.z >= 0 && c.z <= 1;
}

/// 0..1 in every channel; not-a-number becomes 0.
Rgb clamped(const Rgb& c) {
  const auto clampOne = [](float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; };
  return {clampOne(c.x), clampOne(c.y), clampOne(c.z)};
}

ResolvedAlbedo uniformAlbedo(const Rgb& c) {
  if (!inRange(c)) throw usageError("the albedo is out of range", "use values from 0 to 1");
  ResolvedAlbedo result;
  result.albedo.values = {c};
  char text[64];
  if (c.x == c.y && c.y == c.z) {
    std::snprintf(text, sizeof text, "uniform %g", static_cast<double>(c.x));
  } else {
    std::snprintf(text, sizeof text, "uniform %g,%g,%g", static_cast<double>(c.x), static_cast<double>(c.y),
                  static_cast<double>(c.z));
  }
  result.note = text;
  return result;
}

ResolvedAlbedo colorAlbedo(const std::vector<Rgb>& colors, ColorEncoding encoding, bool bytesAreLinear,
                           Albedo::Per per) {
  const bool decode = encoding == ColorEncoding::srgb && !bytesAreLinear;
  ResolvedAlbedo result;
  result.albedo.per = per;
  result.albedo.values.resize(colors.size());
  std::size_t outside = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    outside += inRange(colors[i]) ? 0 : 1;
    result.albedo.values[i] = decode ? srgbToLinear(clamped(colors[i])) : clamped(colors[i]);
  }
  result.note = per == Albedo::Per::vertex ? "vertex colours, " : "face colours, ";
  result.note += decode                            ? "8-bit sRGB decoded to linear"
                 : encoding == ColorEncoding::srgb ? "8-bit taken as linear"
                                                   : "floats taken as linear";
  if (outside > 0)
    result.warnings.push_back(std::to_string(outside) + " colours outside 0..1 were clamped for use as albedo");
  return result;
}

[[noreturn]] void missingColors(const Mesh& mesh, const char* what) {
  throw Error({.file = mesh.source,
               .cause = std::string("has no ") + what + " colours to take albedo from",
               .remedy = "use a uniform albedo instead"});
}

}  // namespace

ResolvedAlbedo resolveAlbedo(const Mesh& mesh, const AlbedoOptions& o) {
  const bool automatic = o.source == AlbedoSource::automatic;
  if (o.source == AlbedoSource::face || (automatic && !mesh.faceColors.empty())) {
    if (mesh.faceColors.empty()) missingColors(mesh, "face");
    return colorAlbedo(mesh.faceColors, mesh.faceColorEncoding, o.bytesAreLinear, Albedo::Per::face);
  }
  if (o.source == AlbedoSource::vertex || (automatic && !mesh.vertexColors.empty())) {
    if (mesh.vertexColors.empty()) missingColors(mesh, "vertex");
    return colorAlbedo(mesh.vertexColors, mesh.vertexColorEncoding, o.bytesAreLinear, Albedo::Per::vertex);
  }
  return uniformAlbedo(o.uniform);
}

}  // namespace shbake
