// How a transfer came about, as facts of a report: said alike of a fresh bake and of a file.
#pragma once

#include "cli/report.h"
#include "shbake.h"

namespace shbake::cli {

/// Adds the size of `set` and, where `facts` is not null, kind, rays, reflections and stated errors to `report`, under
/// the keys "transfer.*" and "error.*", and the surface error where it was measured.
void describeTransfer(const TransferSet& set, const TransferFacts* facts, Report& report);

}  // namespace shbake::cli
