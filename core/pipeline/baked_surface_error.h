// The surface error of a baked file, which has all that is needed to measure it.
#pragma once

#include <cstddef>

#include "base/parallel.h"
#include "base/progress.h"
#include "transfer/baked_ply.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// Measures the surface error (bake/surface_error.h) of a baked mesh at `samples` points, 16..1048576, with the options
/// of its bake as its facts state them. No samples in the result: no face has an area and reflects light.
/// Throws a usage error when `samples` is out of range, and an Error that names the file when it cannot be told how it
/// was baked, its albedo is unknown, or it was baked beside blockers, which it does not hold; cancelled by `progress`.
SurfaceError measureSurfaceError(const BakedPly& baked, std::size_t samples, const Parallel& parallel,
                                 Progress& progress);

}  // namespace shbake
