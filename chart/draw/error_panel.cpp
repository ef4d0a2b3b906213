// What panels of errors share.
#include "chart/draw/error_panel.h"

namespace shbake::chart {
namespace {

constexpr double kPercent = 100;

}  // namespace

void addError(std::vector<Place>& places, double x, double error) {
  if (error > 0) places.push_back({x, kPercent * error});
}

std::vector<Place> errorPlaces(std::span<const CurvePoint> points) {
  std::vector<Place> places;
  for (const CurvePoint& p : points) addError(places, p.cpu, p.error);
  return places;
}

Series frontSeries(std::span<const CurvePoint> points) {
  const std::vector<bool> front = paretoFront(points);
  std::vector<CurvePoint> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (front[i]) best.push_back(points[i]);
  }
  return {"Pareto front", Series::Style::rings, 0, errorPlaces(best)};
}

Panel emptyPanel(const std::string& name, const std::string& title, const Axis& x) {
  Panel panel;
  panel.name = name;
  panel.title = title;
  panel.x = x;
  panel.y = {"error in %", true};
  return panel;
}

Axis timeAxis() {
  return {"CPU time for the whole mesh in seconds", true};
}

}  // namespace shbake::chart
