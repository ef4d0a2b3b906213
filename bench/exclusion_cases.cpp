// Small scenes in which what a ray leaves out decides.
#include "exclusion_cases.h"

#include <cmath>
#include <numeric>

#include "support/shapes.h"

namespace shbake::bench {
namespace {

LightingPoints pointsOf(const Mesh& mesh) {
  Progress progress;
  return makeLightingPoints(mesh, {}, {}, progress);
}

/// The apex looks at the middle of a square lid of side 4 at 2.5e-5 of the diagonal: it sees (gap / 2)^2 of the sky or
/// less.
ExclusionCase lid() {
  const double gap = 2.5e-5 * std::sqrt(32.0);
  ExclusionCase c{"lid", "a lid 2.5e-5 of the diagonal above a vertex", pointsOf(shapes::lidAboveApex(gap)), {}, 0};
  c.judged = {c.points.outputPoint[64]};
  return c;
}

/// The lowest points of a box's sides lie in the ground, which hides all that is below the horizon from them.
ExclusionCase contact() {
  const Mesh upright = shapes::merged(shapes::grid({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}),
                                      shapes::box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, {4, 4, 4}));
  const shapes::Matrix3 first = shapes::rotationAbout({0, 0, 1}, 0.7), second = shapes::rotationAbout({0, 1, 0}, 0.4);
  const Vec3d up = shapes::apply(second, {0, 0, 1});
  ExclusionCase c{"contact",
                  "the foot of a tilted box that stands on the ground",
                  pointsOf(shapes::rotated(shapes::rotated(upright, first), second)),
                  {},
                  0.5};
  for (std::uint32_t p = 0; p < c.points.size(); ++p) {
    const Vec3d place = Vec3d(c.points.positions[c.points.pointPosition[p]]) * (1 / c.points.frame.scale);
    const bool isFoot = std::abs(dot(place + c.points.frame.centre, up)) < 1e-5;
    if (isFoot && std::abs(dot(Vec3d(c.points.pointNormal[p]), up)) < 1e-5) c.judged.push_back(p);
  }
  return c;
}

ExclusionCase room() {
  ExclusionCase c{"closed room", "a closed box seen from inside", pointsOf(shapes::boxRoom(4)), {}, 0};
  c.judged.resize(c.points.size());
  std::iota(c.judged.begin(), c.judged.end(), 0u);
  return c;
}

}  // namespace

std::vector<ExclusionCase> exclusionCases() {
  std::vector<ExclusionCase> cases;
  cases.push_back(lid());
  cases.push_back(contact());
  cases.push_back(room());
  return cases;
}

}  // namespace shbake::bench
