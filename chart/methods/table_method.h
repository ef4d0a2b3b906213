// Estimates from sets of local directions: one loop for all methods that differ in directions or exclusion alone.
#pragma once

#include <functional>
#include <vector>

#include "bake/direction_set.h"
#include "chart/methods/method.h"
#include "chart/methods/plain_view.h"

namespace shbake::chart {

/// Directions for about `rays` rays; sets of other `set` numbers are independent where the method is random.
using MakeSet = std::function<std::vector<WeightedDirection>(int rays, std::uint64_t set)>;

/// How many sets a method draws: one where it makes the same directions each time. Random methods get several, of
/// which each stretch of 64 points takes one: a set for every point would not fit the processor's caches and slow the
/// method down, and a single one would let the error hang on its luck.
enum class Sets { one, several };

/// What a method looks along.
std::vector<DirectionSet> makeSets(const Task& task, const MakeSet& makeSet, Sets sets);

/// t = sum of w_i V_i y(d_i) in the local frame, turned about the normal by a random angle at each point, as
/// DirectTransfer sums it: by shbake's own rays and exclusion, whose search for contacts it counts.
Estimate estimateExactly(const TestBed& bed, const Task& task, Progress& progress,
                         const std::vector<DirectionSet>& sets);

/// The same by the rays of a view, which searches for nothing.
Estimate estimatePlainly(const TestBed& bed, const Task& task, Progress& progress,
                         const std::vector<DirectionSet>& sets, PlainView& view);

/// Runs `body(point, i)` for the chosen points with denormals flushed, as Embree asks for, counting and cancelling;
/// returns the CPU seconds of the calling thread.
double timedOverPoints(std::span<const std::uint32_t> chosen, Progress& progress,
                       const std::function<void(std::uint32_t point, std::size_t i)>& body);

}  // namespace shbake::chart
