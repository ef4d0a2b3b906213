// The families of rows, each a file of its own.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "stability/row.h"

namespace shbake::stability {

std::span<const Row> shRows();       ///< "sh": the mathematics of the basis
std::span<const Row> lightRows();    ///< "light": probes and skies
std::span<const Row> tracingRows();  ///< "tracing": rays beside the surface that they start on
std::span<const Row> contactRows();  ///< "contact": surfaces that touch, overlap or run into each other
std::span<const Row> meshRows();     ///< "meshes": defects of the file
std::span<const Row> energyRows();   ///< "energy": reflections, and sums of many rays
std::span<const Row> scaleRows();    ///< "scale": units, places, precision

/// The names of the families, in the order of the table.
std::vector<std::string_view> familyNames();

/// The rows of a family, or of all where the name is empty. Throws a usage error that lists the names for another word.
std::vector<const Row*> rowsOf(std::string_view family);

}  // namespace shbake::stability
