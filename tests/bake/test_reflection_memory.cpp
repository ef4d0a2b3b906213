// Sharing out memory between hits and solver: budgets are kept, and hits or columns preferred where they save more.
#include <catch2/catch.hpp>

#include "bake/reflection_memory.h"

using namespace shbake;

namespace {

constexpr std::size_t kMega = 1'000'000, kPlenty = std::size_t(64) << 30;
/// What the solver takes: six arrays of floats.
constexpr std::size_t kSolverBytes = 6 * sizeof(float);

}  // namespace

TEST_CASE("hits and solver together keep to the budget", "[reflection_memory]") {
  const std::size_t points = 10007;
  for (const std::size_t columns : {4u, 12u, 16u, 28u, 64u, 1024u}) {
    for (const std::size_t hits : {std::size_t(0), kMega, 20 * kMega, 900 * kMega}) {
      const std::size_t narrowest = points * 4 * kSolverBytes;
      for (std::size_t budget = narrowest; budget < 4000 * kMega; budget = budget * 5 / 4) {
        const ReflectionMemory memory(budget, kPlenty, points, columns);
        CHECK(memory.hitsWhileTracing() == budget - narrowest);
        const ReflectionMemory::Share share = memory.shareOut(hits);
        INFO(columns << " columns, " << hits << " bytes of hits, budget " << budget);
        REQUIRE(share.columns >= 4);
        REQUIRE(share.columns <= columns);
        REQUIRE(share.columns % 4 == 0);
        REQUIRE(share.hits + share.columns * points * kSolverBytes <= budget);
        // All hits were stored while they were traced: none of them is given up for a wider solver.
        if (memory.hitsWhileTracing() >= hits) REQUIRE(share.hits >= hits);
      }
    }
  }
}

TEST_CASE("a budget below the narrowest solver keeps no hits", "[reflection_memory]") {
  const ReflectionMemory memory(1, kPlenty, 1000, 16);
  CHECK(memory.hitsWhileTracing() == 0);
  CHECK(memory.shareOut(kMega).columns == 4);
  CHECK(memory.shareOut(kMega).hits == 0);
}

TEST_CASE("the sufficient budget is the least with which all hits are stored", "[reflection_memory]") {
  const std::size_t points = 1000, hits = 5 * kMega;
  const std::size_t enough = ReflectionMemory(1, kPlenty, points, 16).sufficient(hits);
  CHECK(ReflectionMemory(enough, kPlenty, points, 16).hitsWhileTracing() == hits);
  CHECK(ReflectionMemory(enough, kPlenty, points, 16).shareOut(hits).hits == hits);
  CHECK(ReflectionMemory(enough - 1, kPlenty, points, 16).hitsWhileTracing() < hits);
}

TEST_CASE("where few hits find room, all columns at once spare batches of tracing", "[reflection_memory]") {
  const std::size_t points = 100'000, all = 16 * points * kSolverBytes;
  // Four batches of four columns would trace 97 % again each time, one batch everything.
  CHECK(ReflectionMemory(all, kPlenty, points, 16).shareOut(1000 * kMega).columns == 16);
  // Four batches trace 4 % of 30 MB again each time.
  const ReflectionMemory::Share share = ReflectionMemory(all, kPlenty, points, 16).shareOut(30 * kMega);
  CHECK(share.columns == 4);
  CHECK(share.hits == all * 3 / 4);
}

TEST_CASE("by default the solver takes little that the hits do not take", "[reflection_memory]") {
  // An ordinary mesh: all columns at once, all hits.
  CHECK(ReflectionMemory(0, kPlenty, 100'000, 16).shareOut(25 * kMega).columns == 16);
  // The 2.6 million points of a closed mesh of 5.2 million triangles; 16 rays each, then 64.
  const std::size_t points = 2'621'442;
  const ReflectionMemory large(0, kPlenty, points, 16);
  CHECK(large.shareOut(points * (16 * 8 + 4)).columns == 4);
  CHECK(large.shareOut(points * (64 * 8 + 4)).columns == 16);
  // Who asks for memory gets it used.
  CHECK(ReflectionMemory(2000 * kMega, kPlenty, points, 16).shareOut(points * (16 * 8 + 4)).columns == 16);
  // Half of what is free, however little.
  CHECK(ReflectionMemory(0, 1000 * kMega, points, 16).hitsWhileTracing() == 500 * kMega - points * 4 * kSolverBytes);
}
