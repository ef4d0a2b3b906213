// Rows about reflected light and sums of many rays: what goes in must come out.
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/hash.h"
#include "sh/irradiance.h"
#include "sh/local_frame.h"
#include "sh/quadrature.h"
#include "stability/families.h"
#include "support/shapes.h"

namespace shbake::stability {
namespace {

using std::numbers::pi;
constexpr int kUsualBounces = 3;

BakedMesh reflected(const Mesh& mesh, float albedo, int bounces, int rays, const Bench& bench) {
  BakeMeshOptions options;
  options.albedo.uniform = {albedo, albedo, albedo};
  options.bake.kind = TransferKind::interreflected;
  options.bake.order = 1;
  options.bake.bounces = bounces;
  options.bake.rays = rays;
  return bakeMesh(mesh, {}, options, bench.parallel, bench.progress);
}

/// What a vertex sends out under a sky of radiance 1.
double underWhiteSky(const BakedMesh& baked, std::size_t vertex) {
  return static_cast<double>(baked.transfer.coefficients[vertex]) * std::sqrt(4 * pi);
}

bool saysThatItCannot(const BakedMesh& baked) {
  for (const std::string& warning : baked.warnings) {
    if (warning.find("did not converge") != std::string::npos) return true;
  }
  return false;
}

/// Vertices that send out something else than `truth`, by more than kNoticeable of an open point's light.
Count wrongUnderWhiteSky(const BakedMesh& baked, double truth, double albedo) {
  Count count;
  for (std::size_t v = 0; v < baked.transfer.size(); ++v) {
    count.add(!(std::abs(underWhiteSky(baked, v) - truth) <= kNoticeable * albedo));
  }
  return count;
}

// ---- The white furnace: where everything is white and the sky too, nothing can be told from the sky.

Outcome measureFurnace(const Bench& bench) {
  Outcome outcome;
  std::vector<Mesh> meshes{shapes::bowl(0.5, 12, 24, true), shapes::boxesOnGround(), shapes::corner(4)};
  if (!bench.brief) {
    meshes.push_back(shapes::bowl(0.15, 16, 32, true));
    meshes.push_back(shapes::bowl(2, 12, 24, true));
    meshes.push_back(shapes::openCavity(2, 0.1, 30));
  }
  for (const Mesh& mesh : meshes) {
    outcome.own += wrongUnderWhiteSky(reflected(mesh, 1, BakeOptions::kBouncesAuto, 1024, bench), 1, 1);
    outcome.naive += wrongUnderWhiteSky(reflected(mesh, 1, kUsualBounces, 1024, bench), 1, 1);
  }
  return outcome;
}

// ---- High albedo in cavities: between any two places of a sphere light is exchanged alike, so with f the wall's share
// of the sphere and albedo rho, the wall sends out rho (1 - f) / (1 - rho f).

Outcome measureCavities(const Bench& bench) {
  Outcome outcome;
  const int rings = bench.brief ? 16 : 24;
  for (const double degrees : {8.0, 30.0, 90.0}) {
    const double f = (1 + std::cos(degrees * pi / 180)) / 2;
    const Mesh mesh = shapes::bowl(degrees * pi / 180, rings, 2 * rings, true);
    for (const float albedo : {0.5f, 0.9f, 0.99f}) {
      const double rho = static_cast<double>(albedo), truth = rho * (1 - f) / (1 - rho * f);
      outcome.own += wrongUnderWhiteSky(reflected(mesh, albedo, BakeOptions::kBouncesAuto, 1024, bench), truth, rho);
      outcome.naive += wrongUnderWhiteSky(reflected(mesh, albedo, kUsualBounces, 1024, bench), truth, rho);
    }
  }
  return outcome;
}

Outcome measureClosing(const Bench& bench) {
  Outcome outcome;
  for (const double degrees : {0.5, 1.0, 2.0, 4.0}) {
    if (bench.brief && degrees < 2) continue;
    const Mesh mesh = shapes::bowl(degrees * pi / 180, 12, 24, true);
    const BakedMesh baked = reflected(mesh, 1, BakeOptions::kBouncesAuto, 2048, bench);
    // A hole that no vertex's rays have met lets nothing in.
    double sky = 0;
    for (const float seen : baked.transfer.visibility) sky += static_cast<double>(seen);
    const double truth = sky > 0 ? 1 : 0;
    Count count = wrongUnderWhiteSky(baked, truth, 1);
    if (saysThatItCannot(baked)) count.failures = 0;
    outcome.own += count;
    outcome.naive += wrongUnderWhiteSky(reflected(mesh, 1, kUsualBounces, 2048, bench), truth, 1);
  }
  for (const float albedo : {0.99f, 1.0f}) {
    const Mesh room = shapes::boxRoom(4);
    outcome.own += wrongUnderWhiteSky(reflected(room, albedo, BakeOptions::kBouncesAuto, 256, bench), 0, 1);
    outcome.naive += wrongUnderWhiteSky(reflected(room, albedo, kUsualBounces, 256, bench), 0, 1);
  }
  return outcome;
}

// ---- Reciprocity: with v the light that comes to a place straight from the sky and k the exchange between places, the
// light that A gets from B, weighted by v, equals the light that B gets from A: both are the integral of v(x) k(x,y)
// v(y).

struct Pair {
  Mesh mesh;
  std::size_t split;  ///< vertices from here on belong to the second sheet
};

Pair facingSheets(int number) {
  const auto unit = [&](std::uint64_t i) { return hashUnit(23, 16 * number + i); };
  const Mesh low = shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 20, 20);
  const double side = 0.4 + unit(0);
  Mesh high = shapes::flipped(shapes::grid({-side / 2, -side / 2, 0}, {side, 0, 0}, {0, side, 0}, 10, 10));
  high =
      shapes::rotated(std::move(high), shapes::rotationAbout({1 + unit(1), unit(2) - 0.5, 0}, 0.8 * (unit(3) - 0.5)));
  high = shapes::translated(std::move(high), {unit(4) - 0.5, unit(5) - 0.5, 0.7 + 0.5 * unit(6)});
  return {shapes::merged(low, high), low.positions.size()};
}

std::vector<double> areasOf(const Mesh& mesh) {
  std::vector<double> areas(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3d& a = mesh.positions[t[0]];
    const double area = length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 2;
    for (const std::uint32_t v : t) areas[v] += area / 3;
  }
  return areas;
}

/// What flows from one sheet to the other and back, relative to its mean: 0 where light obeys reciprocity.
double imbalance(const Pair& pair, const std::vector<double>& direct, const std::vector<double>& received) {
  const std::vector<double> areas = areasOf(pair.mesh);
  std::array<double, 2> flow{};
  for (std::size_t v = 0; v < areas.size(); ++v) flow[v < pair.split ? 0 : 1] += areas[v] * direct[v] * received[v];
  return std::abs(flow[0] - flow[1]) / ((flow[0] + flow[1]) / 2);
}

/// Light gathered along directions spread evenly over the hemisphere, without the cosine of the angle at which it comes
/// in: a loop that is often written for ambient occlusion.
std::vector<double> gatheredWithoutCosine(const Pair& pair, const std::vector<double>& direct) {
  constexpr int kRays = 256;
  const Mesh& mesh = pair.mesh;
  std::vector<double> received(direct.size());
  const std::size_t lowFaces = 800;
  for (std::size_t v = 0; v < direct.size(); ++v) {
    const bool isLow = v < pair.split;
    const Triangle& own = mesh.triangles[isLow ? 0 : lowFaces];
    const Vec3d& corner = mesh.positions[own[0]];
    const sh::LocalFrame frame = sh::localFrame(
        normalized(cross(mesh.positions[own[1]] - corner, mesh.positions[own[2]] - corner)), 2 * pi * hashUnit(29, v));
    for (int k = 0; k < kRays; ++k) {
      const double s = (k + 0.5) / kRays, phi = pi * (3 - std::sqrt(5.0)) * k;
      const double r = std::sqrt((1 - s) * (1 + s));
      const Vec3d d = frame.x * (r * std::cos(phi)) + frame.y * (r * std::sin(phi)) + frame.z * s;
      for (std::size_t f = isLow ? lowFaces : 0; f < (isLow ? mesh.triangles.size() : lowFaces); ++f) {
        const Triangle& t = mesh.triangles[f];
        const Vec3d &a = mesh.positions[t[0]], ab = mesh.positions[t[1]] - a, ac = mesh.positions[t[2]] - a;
        const Vec3d p = cross(d, ac), from = mesh.positions[v] - a, q = cross(from, ab);
        const double det = dot(ab, p), u = dot(from, p) / det, w = dot(d, q) / det;
        if (u < 0 || w < 0 || u + w > 1 || dot(ac, q) / det <= 0) continue;
        received[v] += ((1 - u - w) * direct[t[0]] + u * direct[t[1]] + w * direct[t[2]]) / kRays;
        break;
      }
    }
  }
  return received;
}

Outcome measureReciprocity(const Bench& bench) {
  Outcome outcome;
  const std::size_t pairs = bench.brief ? 3 : 12;
  std::vector<Pair> sheets;
  std::vector<std::vector<double>> lights;
  for (std::size_t i = 0; i < pairs; ++i) {
    const Pair pair = facingSheets(static_cast<int>(i));
    const BakedMesh direct = reflected(pair.mesh, 1, 0, 1024, bench), once = reflected(pair.mesh, 1, 1, 1024, bench);
    std::vector<double> light(direct.transfer.size()), received(light.size());
    for (std::size_t v = 0; v < light.size(); ++v) {
      light[v] = underWhiteSky(direct, v);
      received[v] = underWhiteSky(once, v) - light[v];
    }
    outcome.own.add(!(imbalance(pair, light, received) <= kNoticeable));
    sheets.push_back(pair);
    lights.push_back(std::move(light));
  }
  std::vector<double> naive(pairs);
  bench.parallel.forBlocks(pairs, 1, [&](std::size_t i, std::size_t, int) {
    naive[i] = imbalance(sheets[i], lights[i], gatheredWithoutCosine(sheets[i], lights[i]));
  });
  for (const double n : naive) outcome.naive.add(!(n <= kNoticeable));
  return outcome;
}

// ---- Sums of many rays.

/// The transfer of albedo 1 of a point with normal +z that sees a quarter of the azimuths, in closed form but for 24 x
/// 24 nodes of Gauss and Legendre, which are exact to rounding for these polynomials of sines.
std::vector<double> transferOfQuarter(int order) {
  const sh::IntervalRule rule = sh::gaussLegendre(24);
  std::vector<double> sum(static_cast<std::size_t>(order) * order), y(sum.size());
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double theta = (rule.nodes[i] + 1) * pi / 4, phi = (rule.nodes[k] + 1) * pi / 4;
      const double weight = rule.weights[i] * rule.weights[k] * pi / 16 * std::sin(theta) * std::cos(theta);
      sh::evaluate(order, {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}, y);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * y[c];
    }
  }
  return sum;
}

/// The usual loop in single precision: each sample adds its value divided by the number of samples.
std::vector<float> floatSums(int order, int rays) {
  std::vector<float> sum(static_cast<std::size_t>(order) * order), y(sum.size());
  for (int k = 0; k < rays; ++k) {
    const double s = (k + 0.5) / rays, phi = pi * (3 - std::sqrt(5.0)) * k;
    const Vec3d d{std::sqrt(s) * std::cos(phi), std::sqrt(s) * std::sin(phi), std::sqrt(1 - s)};
    if (d.x < 0 || d.y < 0) continue;
    sh::evaluate(order, Vec3f(d), y);
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += y[c] / static_cast<float>(rays);
  }
  return sum;
}

Outcome measureSums(const Bench& bench) {
  constexpr int kOrder = 3;
  Outcome outcome;
  const std::vector<double> exact = transferOfQuarter(kOrder);
  for (const int rays : {100000, 300000, 1000000, 1 << 20}) {
    if (bench.brief && rays != 1000000) continue;
    BakeMeshOptions options;
    options.albedo.uniform = {1, 1, 1};
    options.bake = {.kind = TransferKind::shadowed, .order = kOrder, .rays = rays};
    const BakedMesh baked = bakeMesh(shapes::corner(1), {}, options, bench.parallel, bench.progress);
    const std::vector<float> naive = floatSums(kOrder, rays);
    for (std::size_t v = 0; v < baked.transfer.size(); ++v) {
      if (baked.mesh.positions[v] != Vec3d() || baked.mesh.vertexNormals[v].z < 0.9f) continue;
      for (std::size_t c = 0; c < exact.size(); ++c) {
        const double limit = 1e-4 * sh::unshadowedNorm(kOrder);
        outcome.own.add(!(std::abs(static_cast<double>(baked.transfer.at(v, 0)[c]) - exact[c]) <= limit));
        outcome.naive.add(!(std::abs(static_cast<double>(naive[c]) - exact[c]) <= limit));
      }
    }
  }
  return outcome;
}

constexpr Row kRows[] = {
    {"furnace", "energy", "white surfaces under a white sky (the furnace test)", "grey corners in a white scene",
     "three reflections", "reflections summed until what is missing is a tenth of the tolerance", "--bounces auto",
     "a vertex fails when it is off by 2 % of the sky", 0, measureFurnace},
    {"cavities", "energy", "cavities of albedo up to 0.99", "interiors that are too dark", "three reflections",
     "the equation of light solved by Anderson's method", "--bounces auto",
     "a vertex fails when it is off by 2 % of an open point from the closed form", 0, measureCavities},
    {"closing", "energy", "rooms of albedo 1 that all but close", "interiors that are too dark, without a word",
     "three reflections", "solved, or said in a warning that it could not be", "--bounces auto",
     "a vertex fails when it is off by 2 % and no warning says so", 0, measureClosing},
    {"reciprocity", "energy", "light exchanged between two surfaces", "colour that bleeds too far at grazing angles",
     "directions spread evenly, without the cosine", "directions distributed by cosine", "none: always on",
     "a pair of sheets fails when the light from one to the other differs by 2 % from the way back", 0,
     measureReciprocity},
    {"sums", "energy", "sums of 1e5 to 1e6 rays", "more rays, but no less error",
     "every sample added in single precision", "sums of short blocks, added in double precision", "--rays",
     "a coefficient fails when it is off by 1e-4 of an open point's transfer", 0, measureSums},
};

}  // namespace

std::span<const Row> energyRows() {
  return kRows;
}

}  // namespace shbake::stability
