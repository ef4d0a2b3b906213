// A chart's numbers for programs.
#include "chart/draw/chart_json.h"

#include <nlohmann/json.hpp>

#include "chart/draw/text.h"

namespace shbake::chart {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json pointJson(const CurvePoint& p) {
  return {{"rays", p.rays},   {"traced_rays", p.traced},       {"cpu", p.cpu},  {"cpu_spread", p.cpuSpread},
          {"error", p.error}, {"error_spread", p.errorSpread}, {"runs", p.runs}};
}

const char* groupName(MethodGroup group) {
  switch (group) {
    case MethodGroup::ours:
      return "ours";
    case MethodGroup::directions:
      return "directions";
    case MethodGroup::exclusion:
      return "exclusion";
    default:
      return "programs";
  }
}

Json curvesJson(const ChartData& data) {
  std::vector<CurvePoint> all;
  for (const MethodCurve& c : data.curves) all.insert(all.end(), c.points.begin(), c.points.end());
  const std::vector<bool> front = paretoFront(all);
  std::size_t number = 0;
  Json curves = Json::array();
  for (const MethodCurve& c : data.curves) {
    Json points = Json::array();
    for (const CurvePoint& p : c.points) {
      Json point = pointJson(p);
      point["on_front"] = static_cast<bool>(front[number++]);
      points.push_back(point);
    }
    curves.push_back({{"method", c.method->id},
                      {"title", c.method->title},
                      {"detail", c.method->detail},
                      {"group", groupName(c.method->group)},
                      {"slope", orNull(c.slope)},
                      {"systematic_error", orNull(c.systematic)},
                      {"points", points}});
  }
  return curves;
}

Json ordersJson(const ChartData& data) {
  Json orders = Json::array();
  for (const OrderPoint& p : data.orders) {
    orders.push_back({{"order", p.order},
                      {"bands_left_out", p.truncation},
                      {"under_light", orNull(p.lit)},
                      {"rays_error", p.sampling},
                      {"cpu", p.cpu}});
  }
  return orders;
}

Json bouncesJson(const ChartData& data) {
  if (data.bounces.rays == 0) return nullptr;
  Json points = Json::array();
  for (const BouncePoint& p : data.bounces.points) {
    points.push_back({{"bounces", p.bounces}, {"auto", p.automatic}, {"error", p.error}, {"cpu", p.cpu}});
  }
  return {{"rays", data.bounces.rays}, {"points", points}};
}

const char* refinementName(SurfaceRefinement refinement) {
  switch (refinement) {
    case SurfaceRefinement::even:
      return "even";
    case SurfaceRefinement::automatic:
      return "auto";
    case SurfaceRefinement::chosen:
      return "tolerance";
    default:
      return "none";
  }
}

Json surfaceJson(const ChartData& data) {
  if (data.surface.points.empty()) return nullptr;
  std::vector<CurvePoint> all;
  for (const SurfacePoint& p : data.surface.points) all.push_back(curvePoint(p));
  const std::vector<bool> front = paretoFront(all);
  std::size_t number = 0;
  Json points = Json::array();
  for (const SurfacePoint& p : data.surface.points) {
    points.push_back({{"refinement", refinementName(p.refinement)},
                      {"asked", p.refinement == SurfaceRefinement::none ? Json(nullptr) : Json(p.asked)},
                      {"fit", fitName(p.fit)},
                      {"rays", p.rays},
                      {"vertices", p.vertices},
                      {"cpu", p.cpu},
                      {"error", p.error.rms},
                      {"low", p.error.low},
                      {"high", p.error.high},
                      {"samples", p.error.samples},
                      {"default", isDefault(data.surface, p)},
                      {"on_front", static_cast<bool>(front[number++])}});
  }
  Json advice = Json::array();
  for (const SurfaceAdvice& a : data.surfaceAdvice) {
    advice.push_back({{"error", a.error}, {"point", orNull(a.point)}});
  }
  return {{"rays", data.surface.rays}, {"points", points}, {"advice", advice}};
}

Json adviceJson(const ChartData& data) {
  Json advice = Json::array();
  const std::vector<std::string> sentences = adviceSentences(data);
  for (std::size_t i = 0; i < data.advice.size(); ++i) {
    const Advice& a = data.advice[i];
    advice.push_back({{"error", a.error},
                      {"rays", a.reachable ? Json(a.rays) : Json(nullptr)},
                      {"bounces", orNull(a.bounces)},
                      {"cpu", a.reachable ? Json(a.cpu) : Json(nullptr)},
                      {"sentence", sentences[i]}});
  }
  return advice;
}

}  // namespace

std::string chartJson(const ChartData& data) {
  Json defaults = pointJson(data.defaults);
  defaults["tolerance"] = data.defaultTolerance;
  const Excess excess = excessOfDefault(data, kAllGroups);
  defaults["over_front"] = excess.factor;
  defaults["over_front_beyond_chance"] = excess.beyondChance;
  const Json root{
      {"shbake_chart", 1},
      {"version", SHBAKE_VERSION},
      {"mesh", data.mesh},
      {"triangles", data.faces},
      {"lighting_points", data.points},
      {"measured_points", data.measuredPoints},
      {"order", data.order},
      {"reference", {{"rays", data.referenceRays}, {"points", data.referencePoints}, {"noise", data.referenceNoise}}},
      {"cpu_of_bvh", data.buildSeconds},
      {"cpu_of_contacts", data.contactSeconds},
      {"defaults", defaults},
      {"methods", curvesJson(data)},
      {"light", data.light.empty() ? Json(nullptr) : Json(data.light)},
      {"orders", ordersJson(data)},
      {"reflections", bouncesJson(data)},
      {"surface", surfaceJson(data)},
      {"advice", adviceJson(data)},
      {"notes", data.notes},
      {"seconds", data.seconds},
  };
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace shbake::chart
