// What a fit has to gain: the noise between the vertices, and the bar that a pilot raises.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "bake/fit_prospect.h"
#include "bake/support.h"
#include "bake/surface_places.h"

using namespace shbake;
using namespace shbake::testing;

namespace {

const std::string kNoise = "interpolation between the vertices errs less than the noise of the rays";

}  // namespace

TEST_CASE("the noise between vertices is that of three weights by area", "[fit_prospect]") {
  // Two triangles of areas 1/2 and 1 that share an edge.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  const LightingPoints points = pointsOf(mesh);
  REQUIRE(points.size() == 4);
  const std::vector<double> areas = areaWeights(points, 2);
  std::vector<float> errors(4);
  for (std::uint32_t p = 0; p < 4; ++p) errors[p] = points.filePosition(p) == Vec3d(0, 0, 0) ? 0.5f : 0.25f;
  const double first = (0.25 + 2 * 0.0625) / 6, second = 3 * 0.0625 / 6;
  CHECK(FitProspect(points, areas, errors, 1).noise() ==
        Approx((areas[0] * first + areas[1] * second) / (areas[0] + areas[1])).epsilon(1e-12));
  // A face that does not count.
  CHECK(FitProspect(points, std::vector<double>{0, areas[1]}, errors, 1).noise() == Approx(second).epsilon(1e-12));
  CHECK(FitProspect(points, std::vector<double>{0, 0}, errors, 1).noise() == 0);
}

TEST_CASE("a fit has to be better than rays in the same time", "[fit_prospect]") {
  const LightingPoints points = pointsOf(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 2, 2));
  const std::vector<double> areas = areaWeights(points, points.faces.size());
  const std::vector<float> errors(points.size(), 0.1f);
  const FitProspect prospect(points, areas, errors, 1);
  const double noise = prospect.noise();
  CHECK(noise == Approx(0.01 / 2).epsilon(1e-6));
  // At the least error, what a fit leaves is what points of twice the rays leave.
  const double left = 0.85 * 0.85 * prospect.least(0) + 0.6 * noise;
  CHECK(left == Approx(prospect.least(0) + noise * std::pow(2, -1.5)).epsilon(1e-12));
  // Looking counts four times; in its time, if it is without end, rays would leave no noise.
  CHECK(prospect.least(1e9) == Approx(noise * (0.6 + 3 * std::pow(2, -1.5)) / (1 - 0.85 * 0.85)).epsilon(1e-9));
  CHECK(prospect.least(0.5) > prospect.least(0.1));
  // A fit of more rays leaves less noise, but takes the time of those.
  const FitProspect large(points, areas, errors, 8);
  CHECK(large.least(0) == Approx(noise * (0.6 / std::sqrt(8) - 1.0 / 27) / (1 - 0.85 * 0.85)).epsilon(1e-12));
  // None leaves more than there was.
  CHECK(FitProspect(points, areas, errors, 0.01).least(0) ==
        Approx(noise * (1 - std::pow(1.01, -1.5)) / (1 - 0.85 * 0.85)).epsilon(1e-12));

  CHECK(prospect.whyUseless(0.5 * noise, 0) == kNoise);
  CHECK(prospect.whyUseless(-1, 0) == kNoise);
  CHECK(prospect.whyUseless(1.1 * noise, 0) == nullptr);
  CHECK(prospect.whyUseless(1.1 * noise, 1) ==
        std::string("interpolation between the vertices errs too little beside the noise of the rays"));
  CHECK(prospect.whyUseless(7 * noise, 1e9) == nullptr);
}

TEST_CASE("without noise all that is beyond rounding is worth a fit", "[fit_prospect]") {
  const LightingPoints points = pointsOf(shapes::grid({}, {1, 0, 0}, {0, 1, 0}, 2, 2));
  const std::vector<float> none(points.size(), 0);
  const FitProspect exact(points, areaWeights(points, points.faces.size()), none, 1);
  CHECK(exact.whyUseless(1e-12, 0) == std::string("interpolation between the vertices is exact"));
  CHECK(exact.whyUseless(-1e-15, 3) == std::string("interpolation between the vertices is exact"));
  CHECK(exact.whyUseless(2e-12, 3) == nullptr);
}
