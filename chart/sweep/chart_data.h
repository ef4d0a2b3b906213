// Everything that a chart shows, as numbers: what measuring hands to drawing.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bake/surface_fit.h"
#include "chart/methods/method.h"
#include "chart/sweep/curve.h"
#include "chart/sweep/reference.h"
#include "transfer/transfer_set.h"

namespace shbake::chart {

/// One method at rising effort.
struct MethodCurve {
  const Method* method = nullptr;
  std::vector<CurvePoint> points;  ///< by rising rays
  std::optional<double> slope;     ///< exponent of the error from 64 to 4096 rays
  /// What more rays do not mend: the RMS of the error that independent runs share; nothing where it is not beyond
  /// chance (three standard errors) or was not measured.
  std::optional<double> systematic;
};

/// A number of bands: what the missing ones hold, and what rays cost and err in those there are.
struct OrderPoint {
  int order = 0;
  double truncation = 0;  ///< RMS of the bands from `order` up to kTruncationOrder, relative to the unshadowed transfer
  std::optional<double> lit;  ///< RMS of the radiance that they would add under the light, relative to unshadowed
  double sampling = 0;        ///< error of the rays within the bands
  double cpu = 0;             ///< CPU seconds for the whole mesh
};

/// Bands beyond these are not looked at; of diffuse transfer they hold next to nothing.
inline constexpr int kTruncationOrder = 12;

/// A number of summed reflections.
struct BouncePoint {
  int bounces = 0;         ///< evaluations of the reflection operator: summed reflections, or steps of the solver
  bool automatic = false;  ///< the solver at the tolerance that is the default
  double error = 0;        ///< what is missing, relative to the unshadowed transfer
  double cpu = 0;          ///< CPU seconds of the whole bake
};

struct BounceStudy {
  int rays = 0;  ///< 0: not measured
  std::vector<BouncePoint> points;
};

/// What became of the flat parts of a mesh.
enum class SurfaceRefinement {
  none,       ///< they stay as they are
  even,       ///< edges of one length (mesh/refine.h)
  automatic,  ///< finer where the light changes (pipeline/auto_refine.h)
  chosen      ///< all, rays and fit too, was chosen for a surface error (pipeline/auto_bake.h)
};

/// One bake whose error between the vertices was measured.
struct SurfacePoint {
  SurfaceRefinement refinement = SurfaceRefinement::none;
  double asked = 0;  ///< the length of edges in file units, or the error that was aimed at
  FitKind fit = FitKind::vertex;
  int rays = 0;              ///< of each vertex
  std::size_t vertices = 0;  ///< of the mesh
  double cpu = 0;            ///< CPU seconds of refinement, BVH, bake and fit, on all threads together
  SurfaceError error;
};

struct SurfaceStudy {
  int rays = 0;                      ///< of each vertex by default; 0: not measured
  CacheUse cache = CacheUse::none;   ///< of what the places are judged by
  std::vector<SurfacePoint> points;  ///< in the order in which they were measured, a fit behind what it is a fit of
};

/// Whether a point is what `shbake bake` does by itself.
bool isDefault(const SurfaceStudy& study, const SurfacePoint& point);

/// Its rays, time and error as a place of a curve.
CurvePoint curvePoint(const SurfacePoint& point);

/// What to ask for to reach an error.
struct Advice {
  double error = 0;
  bool reachable = false;
  int rays = 0;
  double cpu = 0;              ///< CPU seconds of the shadowed bake
  std::optional<int> bounces;  ///< reflections that keep within the error; nothing where not measured or not enough
};

/// The setting that took the least time to an error between the vertices.
struct SurfaceAdvice {
  double error = 0;
  std::optional<std::size_t> point;  ///< of SurfaceStudy::points; nothing where none errs so little
};

struct ChartData {
  std::string mesh;  ///< its name
  std::size_t points = 0, faces = 0;
  int order = 0;
  std::size_t referencePoints = 0, measuredPoints = 0;  ///< of the sample
  int referenceRays = 0;
  double referenceNoise = 0;
  CacheUse cache = CacheUse::none;
  double buildSeconds = 0, contactSeconds = 0;  ///< CPU seconds, all of the mesh
  std::vector<MethodCurve> curves;
  CurvePoint defaults;  ///< what `shbake bake` takes by itself
  double defaultTolerance = 0;
  std::string light;  ///< what OrderPoint::lit is for; empty: none
  std::vector<OrderPoint> orders;
  BounceStudy bounces;
  SurfaceStudy surface;
  std::vector<Advice> advice;
  std::vector<SurfaceAdvice> surfaceAdvice;  ///< none where the surface was not measured
  std::vector<std::string> notes;            ///< what was left out and why, one sentence each
  double seconds = 0;                        ///< that measuring took, by the wall clock
};

/// The curve of a method; null where it was not measured.
const MethodCurve* curveOf(const ChartData& data, const char* id);

/// How far the default is from the front of some groups' curves. The same setting on our own curve is not held against
/// it.
Excess excessOfDefault(const ChartData& data, std::span<const MethodGroup> groups);

}  // namespace shbake::chart
