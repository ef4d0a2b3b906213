// Estimates from tables of local directions: one loop for all methods that differ in directions or exclusion alone.
#pragma once

#include <functional>

#include "chart/methods/direction_table.h"
#include "chart/methods/method.h"
#include "chart/methods/point_view.h"

namespace shbake::chart {

/// Directions for about `rays` rays; sets of other `set` numbers are independent where the method is random.
using MakeSet = std::function<std::vector<WeightedDirection>(int rays, std::uint64_t set)>;

/// How many tables a method draws: one where it makes the same directions each time. Random methods get several, of
/// which each stretch of 64 points takes one: a table for every point would not fit the processor's caches and slow the
/// method down, and a single one would let the error hang on its luck.
enum class Tables { one, several };

/// t = sum of w_i V_i y(d_i) in the local frame, turned about the normal by a random angle at each point.
Estimate estimateByTable(const TestBed& bed, const Task& task, Progress& progress, const MakeSet& makeSet,
                         Tables tables, PointView& view);

/// The same by shbake's own rays and exclusion, whose search for contacts it counts.
Estimate estimateByExactTable(const TestBed& bed, const Task& task, Progress& progress, const MakeSet& makeSet,
                              Tables tables);

/// Runs `body(point, i)` for the chosen points with denormals flushed, as Embree asks for, counting and cancelling;
/// returns the CPU seconds of the calling thread.
double timedOverPoints(std::span<const std::uint32_t> chosen, Progress& progress,
                       const std::function<void(std::uint32_t point, std::size_t i)>& body);

}  // namespace shbake::chart
