// The standard error that a bake states for its points.
//
// A lattice of N directions errs where the boundary between free and blocked sky runs through its cells: a cell that
// the boundary crosses counts wholly as one or the other. Each such cell adds independently, so the error's variance
// grows with the number of crossed cells, at (1/N)^2 |y|^2 times a constant a cell, and |y|^2 = n^2 / 4 pi in every
// direction (addition theorem). Crossed cells are counted in the visibility masks, at no cost to the estimate:
// splitting the rays into independent sets, the usual way to a standard error, would lose the lattice's convergence of
// N^-3/4. The constants are measured: the program bench_error compares stated with true errors on meshes, orders and
// ray counts of choice.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Neighbouring directions of a group (24 pairs in its 4 x 4 grid) of which one is set in the mask and the other is
/// not, over all groups: the length of the boundary between free and blocked sky in lattice cells.
std::uint32_t boundaryPairs(std::span<const std::uint16_t> sky);

/// Standard error of the transfer of each point, relative to the unshadowed transfer (|t - t*| / |t_unshadowed|,
/// expectation of the square), at `rays` directions and `order` bands. `pairs` has boundaryPairs() of each point of
/// `points`; `roughness` the unevenness of the reflected light that it sees (Reflections::roughness), or nothing.
/// Points without a boundary are exact where no point of the mesh has one. Elsewhere a sliver of sky may have slipped
/// between the directions: such points get the error that slivers have on average, near a boundary and away from it.
/// Progress counts points.
std::vector<float> statedErrors(const LightingPoints& points, std::span<const std::uint32_t> pairs,
                                std::span<const float> roughness, int rays, int order, Progress& progress);

/// The same as an RMS over some points without regard to their surroundings: what a pilot can tell.
double pilotError(std::span<const std::uint32_t> pairs, std::span<const double> weights, int rays, int order);

/// The area that each lighting point stands for: a third of each face at its corners, in square work units.
std::vector<double> pointAreas(const LightingPoints& points);

}  // namespace shbake
