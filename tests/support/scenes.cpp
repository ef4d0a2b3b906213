// Compound scenes.
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "support/surfaces.h"
#include "support/transforms.h"

namespace shbake::shapes {
namespace {

// A square of side 2 * extent around the origin in z = 0, facing up, as a fan around vertex 0 at the origin.
Mesh squareAroundOrigin(double extent) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {-extent, -extent, 0}, {extent, -extent, 0}, {extent, extent, 0}, {-extent, extent, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  return mesh;
}

Mesh named(Mesh mesh, const char* name) {
  mesh.source = name;
  return mesh;
}

// The five visible sides of a box on the ground, each a grid of its own.
Mesh building(Vec3d lo, double width, double depth, double height, int cells) {
  const int floors = std::max(1, static_cast<int>(cells * height));
  const Vec3d x(width, 0, 0), y(0, depth, 0), z(0, 0, height);
  Mesh mesh = grid(lo, x, z, cells, floors);
  mesh = merged(mesh, grid(lo + x, y, z, cells, floors));
  mesh = merged(mesh, grid(lo + x + y, -x, z, cells, floors));
  mesh = merged(mesh, grid(lo + y, -y, z, cells, floors));
  return merged(mesh, grid(lo + z, x, y, cells, cells));
}

}  // namespace

Mesh floorBesideWall(double height, double distance, double extent) {
  const Mesh wall = grid({distance, extent, 0}, {0, -2 * extent, 0}, {0, 0, height});
  return named(merged(squareAroundOrigin(extent), wall), "floor beside a wall");
}

Mesh discAboveFloor(double radius, double height, int segments) {
  Mesh disc;
  disc.positions.push_back({0, 0, height});
  for (int i = 0; i < segments; ++i) {
    const double phi = 2 * std::numbers::pi * i / segments;
    disc.positions.push_back({radius * std::cos(phi), radius * std::sin(phi), height});
  }
  const auto n = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < n; ++i) disc.triangles.push_back({0, (i + 1) % n + 1, i + 1});
  return named(merged(squareAroundOrigin(0.1 * height), disc), "disc above a floor");
}

Mesh parallelSheets(double gap, int n) {
  const Mesh lower = grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, n, n);
  return named(merged(lower, flipped(translated(lower, {0, 0, gap}))), "parallel sheets");
}

Mesh lidAboveApex(double gap) {
  const double h = 0.01;
  return named(merged(bicone(64, h), grid({-2, -2, h + gap}, {0, 4, 0}, {4, 0, 0})), "lid above an apex");
}

Mesh city(int blocks, int cells, int groundCells, std::uint64_t seed) {
  const int n = blocks * groundCells;
  Mesh mesh = grid({0, 0, 0}, {double(blocks), 0, 0}, {0, double(blocks), 0}, n, n);
  std::uint64_t drawn = 0;
  for (int y = 0; y < blocks; ++y) {
    for (int x = 0; x < blocks; ++x) {
      const double width = 0.3 + 0.4 * hashUnit(seed, drawn++), depth = 0.3 + 0.4 * hashUnit(seed, drawn++);
      const double tallness = hashUnit(seed, drawn++);
      const Vec3d lo(x + 0.5 - width / 2, y + 0.5 - depth / 2, 0);
      mesh = merged(mesh, building(lo, width, depth, 0.2 + 1.8 * tallness * tallness, cells));
    }
  }
  return named(std::move(mesh), "city");
}

Mesh boxesOnGround() {
  Mesh mesh = grid({-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
  mesh = merged(mesh, box({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  for (int i = 1; i < 10; ++i) {
    const Vec3d lo(0.17 * i - 0.85, 0.85, 0);
    mesh = merged(mesh, box(lo, lo + Vec3d(0.1, 0.1, 0.1)));
  }
  return named(std::move(mesh), "boxes on the ground");
}

Mesh tiltedBoxesOnGround() {
  const Mesh turned = rotated(boxesOnGround(), rotationAbout({0, 0, 1}, 0.7));
  return named(rotated(turned, rotationAbout({0, 1, 0}, 0.4)), "tilted boxes on the ground");
}

Mesh tJunctionFloor(int n) {
  const Mesh left = grid({-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, n),
             right = grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, n + 1);
  return named(merged(left, right), "floor with T-junctions");
}

Mesh redFloorWhiteWall(int n) {
  const Mesh floor = colored(grid({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, n), {1, 0, 0});
  const Mesh wall = colored(grid({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, n, n), {1, 1, 1});
  return named(merged(floor, wall), "red floor, white wall");
}

Mesh cornellRoom(int n) {
  const Rgb white(0.75f, 0.75f, 0.75f), red(0.65f, 0.05f, 0.05f), green(0.1f, 0.45f, 0.1f);
  Mesh mesh = colored(grid({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, n, n), white);
  mesh = merged(mesh, colored(grid({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, n, n), white));
  mesh = merged(mesh, colored(grid({-1, 1, 0}, {2, 0, 0}, {0, 0, 2}, n, n), white));
  mesh = merged(mesh, colored(grid({-1, -1, 0}, {0, 2, 0}, {0, 0, 2}, n, n), red));
  mesh = merged(mesh, colored(grid({1, 1, 0}, {0, -2, 0}, {0, 0, 2}, n, n), green));
  const int m = std::max(1, n / 2);
  const Mesh low = rotated(box({-0.3, -0.3, 0}, {0.3, 0.3, 0.6}, {m, m, m}), rotationAbout({0, 0, 1}, -0.3));
  const Mesh tall = rotated(box({-0.3, -0.3, 0}, {0.3, 0.3, 1.2}, {m, m, 2 * m}), rotationAbout({0, 0, 1}, 0.3));
  mesh = merged(mesh, colored(translated(low, {0.35, -0.35, 0}), white));
  mesh = merged(mesh, colored(translated(tall, {-0.35, 0.3, 0}), white));
  return named(std::move(mesh), "room with a red and a green wall");
}

Mesh columns(int rows, int sectors) {
  const std::vector<std::array<double, 2>> profile = {{0.34, 0.0},  {0.34, 0.12}, {0.28, 0.2}, {0.24, 0.26},
                                                      {0.23, 0.8},  {0.21, 1.4},  {0.2, 2.0},  {0.24, 2.1},
                                                      {0.32, 2.22}, {0.32, 2.36}};
  const Mesh column = lathe(profile, sectors);
  Mesh mesh = grid({0, 0, 0}, {double(rows), 0, 0}, {0, double(rows), 0}, 6 * rows, 6 * rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < rows; ++x) mesh = merged(mesh, translated(column, {x + 0.5, y + 0.5, 0}));
  }
  return named(std::move(mesh), "columns");
}

Mesh chessPiece(int level) {
  Mesh mesh = lathe({{0.5, 0.0}, {0.5, 0.1}, {0.42, 0.18}, {0.3, 0.22}, {0.24, 0.3}, {0.2, 0.5}}, 12 << level);
  const Mesh ball = icosphere(level + 1, 0.08);
  for (int i = 0; i < 6; ++i) {
    const double along = i / 5.0;
    const Vec3d centre(0.12 * std::sin(2.5 * along) - 0.25 * along * along, 0, 0.5 + 0.5 * along);
    mesh = merged(mesh, translated(scaled(ball, 0.24 - 0.06 * along), centre));
  }
  return named(merged(mesh, translated(scaled(ball, 0.18), {-0.35, 0, 0.92})), "chess piece");
}

}  // namespace shbake::shapes
