// The mesh doctor: what a mesh has that makes baking or other work on it go wrong.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/mesh.h"

namespace shbake {

/// How often something was found, and where first: `Item` is an index, or two for an edge.
template <class Item>
struct Finding {
  static constexpr std::size_t kExamples = 5;

  std::size_t count = 0;
  std::vector<Item> examples;  ///< the smallest indices, ascending, at most kExamples

  /// Counts one and keeps it where it is among the smallest, so that the order of calls does not matter.
  void add(const Item& item);
};

using IndexFinding = Finding<std::uint32_t>;                ///< of vertices, faces or corners (3 face + 0..2)
using EdgeFinding = Finding<std::array<std::uint32_t, 2>>;  ///< of edges, each as two vertices of the file, ascending

/// What checkMesh() finds. Faces meet where their positions are exactly equal, whatever vertices the file gives them.
/// A face counts in edges, parts and fans unless two of its positions are equal.
struct MeshCheck {
  std::size_t vertices = 0, faces = 0;
  std::size_t positions = 0;  ///< distinct ones, of all vertices
  std::size_t edges = 0;      ///< distinct ones

  IndexFinding degenerateFaces;      ///< with two equal positions, or without area as far as double precision can tell
  IndexFinding duplicateFaces;       ///< with the three positions of an earlier face, in any order
  IndexFinding isolatedVertices;     ///< that no face uses
  IndexFinding duplicatePositions;   ///< vertices at the position of an earlier one
  EdgeFinding boundaryEdges;         ///< of one face
  EdgeFinding nonManifoldEdges;      ///< of three or more faces
  EdgeFinding flippedEdges;          ///< of two faces that are wound against each other
  IndexFinding nonManifoldVertices;  ///< where two or more fans of faces meet in nothing but the point (bow-ties)

  bool cornerNormals = false;    ///< the normals below are those of corners, not of vertices
  IndexFinding zeroNormals;      ///< zero or not finite: to be computed instead
  IndexFinding nonUnitNormals;   ///< longer or shorter than 1 by more than 1 %
  IndexFinding opposingNormals;  ///< faces whose normals together point against their winding

  std::size_t parts = 0;           ///< sets of faces connected across edges
  std::size_t closedParts = 0;     ///< where each edge has an even number of faces
  std::size_t insideOutParts = 0;  ///< closed, wound consistently, and of negative volume

  /// Positions in use - edges + faces, for meshes without non-manifold edges and vertices: 2 for each sphere, 0 for a
  /// torus.
  std::optional<std::int64_t> eulerCharacteristic;

  /// All parts are closed.
  bool closed() const { return parts > 0 && closedParts == parts; }
};

/// Examines a mesh whose indices are in range and whose positions are finite. Takes O(V + F log F) time and, beside the
/// mesh, about 60 bytes a face. Throws an Error for more than 1.4e9 faces, whose corners 32 bits cannot number.
/// Progress counts faces.
MeshCheck checkMesh(const Mesh& mesh, Progress& progress);

/// One sentence a finding, with what it means for the light: only for what was found, the gravest first. A clean mesh
/// gives none.
std::vector<std::string> describeFindings(const MeshCheck& check);

/// One sentence on size and topology: vertices, faces, parts, closed or open.
std::string describeShape(const MeshCheck& check);

}  // namespace shbake
