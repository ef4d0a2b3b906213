// The option that asks for the surface error, and how it is told.
#pragma once

#include <cstddef>
#include <string>

#include "cli/report.h"
#include "shbake.h"

namespace CLI {
class App;
}

namespace shbake::cli {

/// Adds an option `name` with an optional number of samples; without it, `samples` stays 0. `example` shows where the
/// file goes, for whoever puts it where the number is read: "shbake compare BAKED --surface".
void addSurfaceSamples(CLI::App& app, const std::string& name, const std::string& help, const std::string& example,
                       std::size_t& samples);

/// Adds a measured surface error to `report`, under the keys "surface.*".
void describeSurface(const SurfaceError& surface, Report& report);

}  // namespace shbake::cli
