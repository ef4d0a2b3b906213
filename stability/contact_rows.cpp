// Rows about surfaces that touch, overlap or run into each other without sharing vertices.
#include <vector>

#include "stability/families.h"
#include "stability/sky_judge.h"
#include "support/shapes.h"

namespace shbake::stability {
namespace {

std::vector<SkyCase> turnedCases(const std::vector<Mesh>& meshes, SelfHits naive, int turns, std::size_t vertices) {
  std::vector<SkyCase> cases;
  for (const Mesh& mesh : meshes) {
    for (int i = 0; i < turns; ++i) cases.push_back({mesh, turned(i), naive, vertices});
  }
  return cases;
}

/// A floor with a smaller one in its plane, of other cells.
Mesh decal() {
  return shapes::merged(shapes::grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 3, 3),
                        shapes::grid({-0.5, -0.5, 0}, {1.125, 0, 0}, {0, 0.875, 0}, 2, 2));
}

/// Two boxes side by side with one side in common, of which each has its own faces.
Mesh blocks() {
  return shapes::merged(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 0.25, 0}, {2, 1.25, 0.75}));
}

/// A box on a slab, sunk into it by `depth`: its lowest vertices are buried.
Mesh sunkBox(double depth) {
  return shapes::merged(shapes::box({-2, -2, -1}, {2, 2, 0}, {3, 3, 1}),
                        shapes::box({-0.5, -0.5, -depth}, {0.5, 0.5, 1}, {2, 2, 2}));
}

Outcome measureOverlaps(const Bench& bench) {
  return judgeSkies(turnedCases({decal(), blocks()}, SelfHits::counted, bench.brief ? 2 : 5, 32), bench);
}

Outcome measureTJunctions(const Bench& bench) {
  const std::vector<Mesh> meshes{shapes::tJunctionFloor(4), shapes::tJunctionFloor(7)};
  return judgeSkies(turnedCases(meshes, SelfHits::facesOfVertex, bench.brief ? 2 : 5, 48), bench);
}

Outcome measureTouching(const Bench& bench) {
  return judgeSkies(turnedCases({shapes::boxesOnGround()}, SelfHits::nearOnes, 1, bench.brief ? 48 : 300), bench);
}

Outcome measureTilted(const Bench& bench) {
  return judgeSkies(turnedCases({shapes::boxesOnGround()}, SelfHits::facesOfVertex, bench.brief ? 2 : 6, 64), bench);
}

Outcome measureInterpenetrating(const Bench& bench) {
  const std::vector<Mesh> meshes{sunkBox(0.3), sunkBox(1e-3), sunkBox(1e-5), sunkBox(1e-6)};
  return judgeSkies(turnedCases(meshes, SelfHits::nearOnes, bench.brief ? 1 : 3, 60), bench);
}

#define SHBAKE_VERTEX_FAILS "a vertex fails when its transfer is off by 2 % of an open point's"

constexpr Row kRows[] = {
    {"overlaps", "contact", "faces in one plane that overlap, and solids that share a side",
     "patches that flicker between black and white", "every hit in front of the vertex counts",
     "faces that the vertex lies on count as its own, and block as half and whole circles", "none: always on",
     SHBAKE_VERTEX_FAILS, 0, measureOverlaps},
    {"t-junctions", "contact", "T-junctions", "black dots along the seams of a floor",
     "faces that have the vertex as a corner do not count", "faces whose edge the vertex lies on are among its own",
     "none: always on", SHBAKE_VERTEX_FAILS, 0, measureTJunctions},
    {"touching", "contact", "solids that stand on a ground", "objects that float: no shadow at their foot",
     "hits nearer than 1e-4 of the diagonal do not count", "the ground blocks its half of the world", "none: always on",
     SHBAKE_VERTEX_FAILS, 0, measureTouching},
    {"tilted-contact", "contact", "the same at any angle, where coordinates are rounded",
     "some corners black, others lit, by chance", "faces that have the vertex as a corner do not count",
     "contact within 1 ulp of the coordinates, measured to the plane", "none: always on", SHBAKE_VERTEX_FAILS, 0,
     measureTilted},
    {"interpenetrating", "contact", "solids that run into each other, by 0.3 down to 1e-6",
     "bright dots along the line where they meet", "hits nearer than 1e-4 of the diagonal do not count",
     "no least distance: a vertex below a surface is in the dark", "none: always on", SHBAKE_VERTEX_FAILS, 0,
     measureInterpenetrating},
};

}  // namespace

std::span<const Row> contactRows() {
  return kRows;
}

}  // namespace shbake::stability
