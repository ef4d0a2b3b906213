// Which albedo a mesh's faces and vertices have.
#pragma once

#include <string>
#include <vector>

#include "mesh/lighting_points.h"
#include "mesh/mesh.h"

namespace shbake {

/// Where albedo is taken from.
enum class AlbedoSource {
  automatic,  ///< the file's colours where it has them (faces before vertices), else `uniform`
  uniform,    ///< one value for the whole mesh
  vertex,     ///< the file's vertex colours; an error where there are none
  face,       ///< the file's face colours (MTL Kd); an error where there are none
};

struct AlbedoOptions {
  AlbedoSource source = AlbedoSource::automatic;
  Rgb uniform{0.8f, 0.8f, 0.8f};  ///< linear, 0..1
  /// 8-bit colours are display values and sRGB-decoded, unless this says that they are linear already.
  bool bytesAreLinear = false;
};

/// The albedo of a mesh, and a note for reports that says what was taken.
struct ResolvedAlbedo {
  Albedo albedo;
  std::string note;
  std::vector<std::string> warnings;
};

/// Throws a usage error for a uniform albedo outside 0..1, a work error naming the mesh where it lacks the colours
/// asked for. Colours outside 0..1 are clamped, with a warning: a surface that reflects more than it receives has no
/// solution.
ResolvedAlbedo resolveAlbedo(const Mesh& mesh, const AlbedoOptions& options);

}  // namespace shbake
