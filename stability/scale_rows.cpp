// Rows about units, places and precision: what a bake must not depend on.
#include <cmath>
#include <vector>

#include "base/hash.h"
#include "stability/families.h"
#include "stability/sky_judge.h"
#include "support/shapes.h"

namespace shbake::stability {
namespace {

Outcome measureUnits(const Bench& bench) {
  std::vector<SkyCase> cases;
  for (const double unit : {1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12}) {
    if (bench.brief && std::abs(std::log10(unit)) < 12) continue;
    for (const Mesh& mesh : {shapes::boxesOnGround(), shapes::openCavity(2, 0.1, 40)}) {
      cases.push_back({mesh, {.scale = unit}, SelfHits::nearOnesByUnit, 30});
    }
  }
  return judgeSkies(cases, bench);
}

Outcome measurePlaces(const Bench& bench) {
  std::vector<SkyCase> cases;
  for (const double far : {1e2, 1e4, 1e5, 1e6}) {
    if (bench.brief && far < 1e5) continue;
    for (const Mesh& mesh : {shapes::boxesOnGround(), shapes::openCavity(2, 0.1, 40)}) {
      const double diagonal = 6;  // that of the boxes; the cavity's is 3.5
      cases.push_back({mesh, {.offset = Vec3d(0.7, -0.5, 0.5) * (far * diagonal)}, SelfHits::nearOnes, 30});
    }
  }
  return judgeSkies(cases, bench);
}

// ---- Watertightness.

/// Whether a ray in single precision meets a triangle, by Moeller and Trumbore.
bool hits(const Vec3f& origin, const Vec3f& d, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = b - a, ac = c - a, p = cross(d, ac), s = origin - a;
  const float det = dot(ab, p), u = dot(s, p) / det;
  if (!(u >= 0 && u <= 1)) return false;
  const Vec3f q = cross(s, ab);
  const float v = dot(d, q) / det;
  return v >= 0 && u + v <= 1 && dot(ac, q) / det > 0;
}

/// Rays from near the middle of a closed mesh to places on its edges, each of which meets a face.
Count aimedAtEdges(const Mesh& mesh, std::size_t rays) {
  Count count;
  for (std::size_t i = 0; i < rays; ++i) {
    const Triangle& face = mesh.triangles[hashBits(3, i) % mesh.triangles.size()];
    const double t = hashUnit(4, i);
    const Vec3d origin{0.1 * hashUnit(5, i), 0.1 * hashUnit(6, i), 0.1 * hashUnit(7, i)};
    const Vec3d place = mesh.positions[face[0]] * (1 - t) + mesh.positions[face[1]] * t;
    const Vec3f d(normalized(place - origin)), from(origin);
    bool met = false;
    for (const Triangle& f : mesh.triangles) {
      met = met || hits(from, d, Vec3f(mesh.positions[f[0]]), Vec3f(mesh.positions[f[1]]), Vec3f(mesh.positions[f[2]]));
    }
    count.add(!met);
  }
  return count;
}

Outcome measureWatertight(const Bench& bench) {
  const Mesh ball = shapes::inwardSphere(bench.brief ? 2 : 3, 0.2);
  Outcome outcome;
  outcome.naive = aimedAtEdges(ball, bench.brief ? 4000 : 20000);
  BakeMeshOptions options;
  options.bake.kind = TransferKind::shadowed;
  options.bake.order = 1;
  options.bake.rays = bench.brief ? 1024 : 8192;
  for (const Mesh& mesh :
       {ball, shapes::inwardSphere(bench.brief ? 3 : 4, 0.05), shapes::boxRoom(bench.brief ? 8 : 24)}) {
    const BakedMesh baked = bakeMesh(mesh, {}, options, bench.parallel, bench.progress);
    for (const float seen : baked.transfer.visibility) {
      outcome.own.cases += static_cast<std::size_t>(baked.facts.rays);
      outcome.own.failures += static_cast<std::size_t>(std::lround(seen * static_cast<float>(baked.facts.rays)));
    }
  }
  return outcome;
}

#define SHBAKE_VERTEX_FAILS "a vertex fails when its transfer is off by 2 % of an open point's"

constexpr Row kRows[] = {
    {"units", "scale", "units of 1e-12 to 1e12", "no shadows at all, or nothing but shadows, after an export in metres",
     "hits nearer than 1e-4 of the file's units do not count", "traced in a frame of its own, scaled by a power of two",
     "none: always on", SHBAKE_VERTEX_FAILS, 0, measureUnits},
    {"places", "scale", "places up to 1e6 diagonals from the origin",
     "noise that grows with the distance from the origin", "coordinates in single precision",
     "centred in double precision before rounding", "none: always on", SHBAKE_VERTEX_FAILS, 0, measurePlaces},
    {"watertight", "scale", "float and double at the edges of faces", "pinholes: single bright dots inside",
     "a face at a time in single precision, aimed at edges",
     "Embree's fast traversal, with the rays of a bake, which pass edges by chance", "none: always on",
     "a ray from within a closed mesh fails when it meets no face; 8.2 in a million pass an edge within 2^-24, the "
     "rounding of a direction, and a sixth of these would get through if both faces erred evenly up to that",
     1e-6, measureWatertight},
};

}  // namespace

std::span<const Row> scaleRows() {
  return kRows;
}

}  // namespace shbake::stability
