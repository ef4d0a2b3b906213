// What each number of bands leaves out, errs and costs.
#pragma once

#include <span>
#include <vector>

#include "chart/sweep/chart_data.h"
#include "light/light.h"

namespace shbake::chart {

/// Measures orders 1 to 8 at `rays` rays on the first `count` points of the sample. `light`, where it is not null, is
/// what OrderPoint::lit is measured under.
std::vector<OrderPoint> studyOrders(const TestBed& bed, std::span<const std::uint32_t> sample,
                                    const Reference& reference, std::size_t count, int rays, const Light* light,
                                    const Parallel& parallel, Progress& progress);

}  // namespace shbake::chart
