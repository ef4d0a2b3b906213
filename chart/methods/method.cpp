// The list of methods, and what they share.
#include "chart/methods/method.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/error.h"
#include "chart/methods/cpu_clock.h"

namespace shbake::chart {
namespace {

constexpr std::array kMethods{
    Method{"shbake", "shbake", "cosine Fibonacci lattice turned at each point, control variate, exact exclusion",
           MethodGroup::ours, true, estimateShbake},
    Method{"fibonacci", "Fibonacci, no control variate", "the same without the control variate",
           MethodGroup::directions, true, estimatePlainFibonacci},
    Method{"cosine-sobol", "Owen-scrambled Sobol", "cosine-distributed, Sobol' points with Owen's scrambling",
           MethodGroup::directions, true, estimateCosineSobol},
    Method{"cosine-hammersley", "Hammersley, turned", "cosine-distributed Hammersley points turned at each point",
           MethodGroup::directions, true, estimateCosineHammersley},
    Method{"gauss-product", "Gauss product",
           "Gauss-Legendre in the squared cosine times equal steps in azimuth, turned", MethodGroup::directions, true,
           estimateGaussProduct},
    Method{"cosine-jittered", "jittered", "cosine-distributed, one direction at random in each cell of a grid",
           MethodGroup::directions, true, estimateCosineJittered},
    Method{"cosine-random", "random", "cosine-distributed, independent", MethodGroup::directions, true,
           estimateCosineRandom},
    Method{"near-epsilon", "rays begin at 1e-4 diagonal", "our directions; rays begin at 1e-4 of the diagonal",
           MethodGroup::exclusion, false, estimateNearEpsilon},
    Method{"normal-offset", "origin 1e-4 diagonal off",
           "our directions; origins moved by 1e-4 of the diagonal along the "
           "normal",
           MethodGroup::exclusion, false, estimateNormalOffset},
    Method{"neighbours-out", "neighbours left out",
           "our directions; faces around the vertex left out, nothing put in "
           "their place",
           MethodGroup::exclusion, false, estimateNeighboursOut},
    Method{"green", "Green's loop", "jittered full sphere shared by all points, rays one by one, neighbours left out",
           MethodGroup::programs, false, estimateGreen},
    Method{"libigl", "libigl's loop",
           "one stratified sphere for all points, folded up; origin moved by 1e-4 file units", MethodGroup::programs,
           false, estimateLibigl},
    Method{"meshlab", "MeshLab's loop",
           "Fibonacci sphere from the faces' centres, from 1e-5 file units on, averaged to "
           "vertices",
           MethodGroup::programs, false, estimateMeshLab},
};

}  // namespace

TestBed::TestBed(const LightingPoints& points, const Parallel& parallel, Progress& progress)
    : points_(points), bare_(points, false), neighboursOut_(points, true) {
  StageClock clock;
  Progress stages(
      [&, note = clock.callback()](const ProgressState& state) { return note(state) && progress.tryAdvance(0); },
      Progress::Duration(0));
  progress.begin("building", 0, "faces");
  const double start = cpuSeconds();
  exact_ = std::make_unique<RayScene>(points, std::numeric_limits<float>::infinity(), parallel, stages);
  const double all = cpuSeconds() - start;
  clock.finish();
  buildSeconds_ = clock.seconds("building");
  contactSeconds_ = all - buildSeconds_;
  progress.end();
}

std::span<const Method> allMethods() {
  return kMethods;
}

const Method& methodNamed(std::string_view id) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return id == m.id; });
  if (found != kMethods.end()) return *found;
  std::string names;
  for (const Method& m : kMethods) names += (names.empty() ? "" : ", ") + std::string(m.id);
  throw usageError("there is no method '" + std::string(id) + "'", "the methods are " + names);
}

}  // namespace shbake::chart
