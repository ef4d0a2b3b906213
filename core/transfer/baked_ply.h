// Baked meshes as PLY files, the main output (design: conventions "PLY").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "mesh/mesh.h"
#include "mesh/ply_header.h"
#include "transfer/transfer_set.h"

namespace shbake {

struct BakedPlyOptions {
  bool ascii = false;  ///< text instead of binary, little endian
};

/// Writes a mesh with a transfer vector for each vertex: x y z nx ny nz, what the mesh carries (its colours too),
/// "quality" (visibility) where the set has it, the coefficients, "sh_error" where the set has it, "source_vertex"
/// where `sourceVertex` is not empty; faces as triangles. The header states the facts. What the mesh carries under one
/// of these names, older facts among its comments and its corner normals are left out. Throws a usage error when an
/// array does not have one item for each vertex, normals are missing, a number is not finite or a visibility not 0..1;
/// and what AtomicFile throws. Progress counts rows.
void writeBakedPly(const std::string& path, const Mesh& mesh, const TransferSet& transfer, const TransferFacts& facts,
                   std::span<const std::uint32_t> sourceVertex, const BakedPlyOptions& options, Progress& progress);

/// What a baked file holds.
struct BakedPly {
  Mesh mesh;                                ///< without the columns and comments of the transfer
  TransferSet transfer;                     ///< in shbake's basis, one vector for each vertex
  TransferFacts facts;                      ///< defaults where `stated` is false
  bool stated = false;                      ///< the header has shbake comments
  std::vector<std::uint32_t> sourceVertex;  ///< as written, or empty
  std::vector<std::string> notes;           ///< what was assumed, converted or ignored, one sentence each
};

/// Reads a baked file, also from other programs: without comments the conventions of shbake are assumed, and `notes`
/// says so. Coefficients with Condon-Shortley phase are converted: those of odd m change their sign, exactly.
/// "quality" is taken as visibility only in files with comments, and where all values are 0..1.
/// Throws what readPly(), parseFacts() and findShColumns() throw, and an Error that names the vertex or property for
/// coefficients that are not finite, negative errors, and source vertices out of range.
BakedPly readBakedPly(const std::string& path, Progress& progress);

/// What the header alone tells about a baked file.
struct BakedPlyInfo {
  PlyHeader header;
  int order = 0;
  int channels = 0;
  TransferFacts facts;
  bool stated = false;          ///< the header has shbake comments
  bool condonShortley = false;  ///< the coefficients will be converted on reading
  bool hasError = false, hasVisibility = false, hasSourceVertex = false;
  std::vector<std::string> notes;
};

/// Reads the header of a baked file; nothing when its vertices have no coefficients. Throws what readPlyHeader(),
/// parseFacts() and findShColumns() throw.
std::optional<BakedPlyInfo> readBakedPlyInfo(const std::string& path);

/// True when the file is a PLY file whose header declares coefficients without contradiction. Never throws Error.
bool isBakedPly(const std::string& path);

}  // namespace shbake
