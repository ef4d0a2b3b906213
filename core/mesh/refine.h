// Refinement: flat regions of a mesh get more vertices, for light to be baked into.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/flat_parts.h"
#include "mesh/mesh.h"
#include "mesh/refine_length.h"

namespace shbake {

struct RefineOptions {
  double flatDegrees = FlatOptions{}.flatDegrees;      ///< see FlatOptions
  double creaseDegrees = FlatOptions{}.creaseDegrees;  ///< see FlatOptions
  std::size_t maxVertices = 10'000'000;                ///< of the refined mesh; beyond, an Error is thrown
};

/// A flat region that was left as it was, in part or as a whole.
struct UnrefinedRegion {
  std::uint32_t firstFace = 0;  ///< the least of the faces left, by number in the input
  std::size_t faces = 0;        ///< how many were left
  std::string reason;           ///< a clause: "its faces are too thin ..."
};

struct RefineReport {
  std::size_t regions = 0;                ///< flat ones
  std::size_t flatFaces = 0;              ///< of the input, in flat regions
  std::size_t refined = 0;                ///< regions that got new faces
  std::vector<UnrefinedRegion> left;      ///< regions that should have, but could not; others were fine enough
  double flatArea = 0;                    ///< of the input's flat regions, in square file units
  std::array<std::size_t, 2> vertices{};  ///< before and after
  std::array<std::size_t, 2> faces{};     ///< before and after
  std::array<double, 2> area{};           ///< before and after, in square file units
};

/// More vertices than allowed would be made.
class TooManyVertices : public Error {
 public:
  using Error::Error;
};

struct RefinedMesh {
  Mesh mesh;
  std::vector<std::uint32_t> sourceFace;  ///< the input's face behind each face
  RefineReport report;
};

/// Divides the flat regions of a mesh (findFlatRegions() says which they are) into triangles with sides of about
/// `length`; along lines where other faces meet a region (contact_lines.h), two rows of vertices keep apart what lies
/// on either side. All else stays: shape, curved parts vertex for vertex and face for face, edges between faces that do
/// not lie in one plane to rounding or across which attributes do not go on, and every vertex of the input in its
/// place; new vertices come behind them, new faces in place of the ones they are part of. An edge between two flat
/// regions is divided alike for both; one with a face that is in none is not divided. New vertices lie on the faces of
/// the input to 4 units in the last place, and carry what these have there. The result does not depend on the number of
/// threads. Throws an Error for indices or positions that are not valid and for more than `maxVertices` vertices, usage
/// errors for angles out of range or lengths that are not positive.
RefinedMesh refineFlatRegions(const Mesh& mesh, const RefineOptions& options, const EdgeLength& length,
                              const Parallel& parallel, Progress& progress);

/// The same where the flat parts of `mesh` are known, by findFlatParts() and addPatches(). Throws the rest.
RefinedMesh refineFlatParts(const Mesh& mesh, const FlatParts& parts, std::size_t maxVertices, const EdgeLength& length,
                            const Parallel& parallel, Progress& progress);

}  // namespace shbake
