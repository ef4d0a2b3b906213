// Compound scenes: floors, walls, lids, boxes in contact, rooms with coloured walls.
#pragma once

#include <cstdint>

#include "mesh/mesh.h"

namespace shbake::shapes {

/// A floor z = 0 of half-size `extent` whose vertex 0 is the origin, and a wall x = distance, |y| <= extent,
/// 0 <= z <= height, that faces it. As extent / height grows, the sky seen from the origin (cosine-weighted) tends to
/// 1 - (1 - 1/sqrt(1 + (height/distance)^2)) / 2.
Mesh floorBesideWall(double height, double distance, double extent);

/// A small square floor around the origin (vertex 0, normal +z) and above it, at z = height, a disc of the given radius
/// as a regular polygon of `segments` corners, facing down. The disc hides radius^2 / (radius^2 + height^2) of the sky.
Mesh discAboveFloor(double radius, double height, int segments);

/// Two parallel squares of side 2 around the z axis, n x n cells each, at z = 0 (facing up) and z = gap (facing down).
Mesh parallelSheets(double gap, int n = 1);

/// A bicone of 64 corners and height 0.01 and a square lid of side 4 at `gap` above its upper apex, which is vertex 64.
Mesh lidAboveApex(double gap);

/// blocks x blocks unit plots on a ground plane, one box without a bottom on each, of a size drawn from `seed`. Boxes
/// touch the ground without sharing vertices with it; sides are split into `cells` cells, the ground into blocks *
/// groundCells.
Mesh city(int blocks, int cells, int groundCells, std::uint64_t seed = 7);

/// Ten closed boxes standing on a square ground of side 4 with their bottoms in its plane, no vertices shared. Box 0
/// has side 1 and stands at the origin; its bottom's corners are among the vertices 4..11 (z = 0).
Mesh boxesOnGround();

/// boxesOnGround() turned about two axes so that no coordinate is exact any more.
Mesh tiltedBoxesOnGround();

/// A flat floor whose two halves meet along x = 0 without sharing vertices: one half has n cells there, the other n
/// + 1.
Mesh tJunctionFloor(int n = 4);

/// A red floor (1, 0, 0) of n x n cells in z = 0 and a white wall in x = 0 that share an edge, as linear face colours.
Mesh redFloorWhiteWall(int n = 8);

/// A room of side 2 around (0, 0, 1), open towards -y, with a red left wall (-x), a green right wall, white elsewhere,
/// and two white boxes on its floor; colours are linear face colours. Walls have n x n cells.
Mesh cornellRoom(int n = 8);

/// rows x rows columns (surfaces of revolution with a base and a capital) on a floor.
Mesh columns(int rows, int sectors);

/// A chess knight's kin: a turned foot, a bent neck and a head of displaced spheres that run into each other.
Mesh chessPiece(int level);

}  // namespace shbake::shapes
