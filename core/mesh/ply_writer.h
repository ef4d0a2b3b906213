// Meshes to PLY files, row by row from views of arrays that stay where they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/mesh.h"
#include "mesh/ply_header.h"

namespace shbake {

/// One column to be written: where its values lie in memory. All pointers are borrowed.
struct PlyColumnView {
  PlyProperty property;                       ///< as the header declares it
  const std::byte* data = nullptr;            ///< the first scalar of item 0
  std::size_t stride = 0;                     ///< bytes from item to item; unused where `listStarts` is set
  std::size_t listLength = 1;                 ///< scalars of an item: 1, or the length that all lists share
  const std::uint64_t* listStarts = nullptr;  ///< lists of unequal length: as in Property
  bool narrowed = false;                      ///< stored as double, declared and written as float
};

/// One element to be written.
struct PlyElementView {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyColumnView> columns;
};

/// A scalar column of `type` (see PlyColumnView for the rest).
PlyColumnView viewScalars(std::string name, ScalarType type, const void* first, std::size_t stride);

/// A carried property of an element with `count` items. Throws a usage error when it holds another number of them.
PlyColumnView viewProperty(const Property& property, std::size_t count);

/// A mesh seen as the elements of a PLY file: "vertex", "face", then the mesh's further elements.
struct PlyMeshView {
  std::vector<PlyElementView> elements;
  std::vector<Property> colors;  ///< columns made from the mesh's colours, where no property holds them
};

/// What readPly() reads back as the same mesh: vertex x y z as float or double, nx ny nz, the carried properties; face
/// vertex_indices, source_polygon and corner_normals where the mesh has them, the carried properties. A carried
/// property with the name of one of these is replaced. Borrows `mesh`. Throws a usage error when arrays of the mesh do
/// not have the sizes that mesh.h states.
PlyMeshView viewMesh(const Mesh& mesh);

/// Writes a PLY file that appears whole or not at all. ASCII numbers take the shortest form that reads back to the same
/// value. Throws a usage error for names that no header can hold, an Error for a list longer than the type of its
/// length can tell, and what AtomicFile throws. Progress counts rows.
void writePlyElements(const std::string& path, PlyEncoding encoding, const std::vector<std::string>& comments,
                      std::span<const PlyElementView> elements, Progress& progress);

struct PlyWriteOptions {
  PlyEncoding encoding = PlyEncoding::binaryLittleEndian;
};

/// Writes viewMesh() and the mesh's comments.
void writePly(const std::string& path, const Mesh& mesh, const PlyWriteOptions& options, Progress& progress);

}  // namespace shbake
