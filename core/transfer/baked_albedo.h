// The albedo behind a baked file, told again from its facts and colours.
#pragma once

#include <optional>
#include <vector>

#include "base/vec3.h"
#include "transfer/baked_ply.h"

namespace shbake {

/// Linear albedo 0..1 of each vertex: what the facts state, with the colours that the mesh carries (clamped, as for
/// baking). A vertex takes the colour of any face that uses it, since vertices are split where albedo changes; one
/// that no face uses is black. White where the transfer leaves albedo out. Nothing when the facts do not tell, or the
/// colours that they speak of are gone.
std::optional<std::vector<Rgb>> bakedAlbedo(const BakedPly& baked);

}  // namespace shbake
