// What panels of errors share.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "chart/draw/panel.h"
#include "chart/sweep/curve.h"

namespace shbake::chart {

/// Adds an error in percent; one of 0 has no place on a logarithmic axis.
void addError(std::vector<Place>& places, double x, double error);

/// The errors of a curve by CPU time.
std::vector<Place> errorPlaces(std::span<const CurvePoint> points);

/// Rings around the Pareto front of `points`.
Series frontSeries(std::span<const CurvePoint> points);

/// A panel without series whose y axis is an error in percent.
Panel emptyPanel(const std::string& name, const std::string& title, const Axis& x);

/// "CPU time for the whole mesh in seconds".
Axis timeAxis();

}  // namespace shbake::chart
