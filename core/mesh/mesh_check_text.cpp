// The findings of checkMesh() in plain words.
#include <cstddef>
#include <string>
#include <vector>

#include "mesh/mesh_check.h"

namespace shbake {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string exampleText(std::uint32_t index) {
  return std::to_string(index);
}
std::string exampleText(const std::array<std::uint32_t, 2>& edge) {
  return std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
}

class Lines {
 public:
  /// Adds "COUNT ONE|MANY: CONSEQUENCE (KIND a, b, …)" where something was found.
  template <class Item>
  void add(const Finding<Item>& finding, const char* one, const char* many, const char* consequence, const char* kind) {
    if (finding.count == 0) return;
    std::string line = counted(finding.count, one, many) + ": " + consequence + " (" + kind;
    for (std::size_t i = 0; i < finding.examples.size(); ++i) {
      line += (i == 0 ? " " : ", ") + exampleText(finding.examples[i]);
    }
    lines_.push_back(line + (finding.count > finding.examples.size() ? ", …)" : ")"));
  }
  void add(std::string line) { lines_.push_back(std::move(line)); }

  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> describeFindings(const MeshCheck& check) {
  Lines lines;
  lines.add(check.boundaryEdges, "boundary edge", "boundary edges", "the mesh is open; light enters through the holes",
            "vertices");
  lines.add(check.flippedEdges, "edge between faces wound against each other",
            "edges between faces wound against each other",
            "the faces disagree on which side is outside; normals computed there are wrong", "vertices");
  if (check.insideOutParts > 0) {
    lines.add(counted(check.insideOutParts, "closed part is", "closed parts are") +
              " inside out: light is gathered on the inner side, which is right only for cavities");
  }
  lines.add(check.opposingNormals, "face whose normals oppose its winding", "faces whose normals oppose their winding",
            "the side of the normals is lit", "faces");
  lines.add(check.nonManifoldEdges, "edge of three or more faces", "edges of three or more faces",
            "which faces continue each other there is not defined", "vertices");
  lines.add(check.nonManifoldVertices, "vertex where separate fans of faces touch",
            "vertices where separate fans of faces touch", "they share their light there where their normals agree",
            "vertices");
  lines.add(check.duplicateFaces, "face that repeats an earlier one", "faces that repeat earlier ones",
            "time is lost, and smooth normals count them twice", "faces");
  lines.add(check.degenerateFaces, "face without area", "faces without area",
            "no light is blocked by them and no normal comes from them", "faces");
  const char* kind = check.cornerNormals ? "corners" : "vertices";
  lines.add(check.zeroNormals, "normal is missing", "normals are missing", "computed from the faces instead", kind);
  lines.add(check.nonUnitNormals, "normal is not of unit length", "normals are not of unit length",
            "scaled to unit length for the bake", kind);
  lines.add(check.isolatedVertices, "vertex that no face uses", "vertices that no face uses",
            "kept in the output, without light", "vertices");
  lines.add(check.duplicatePositions, "vertex at the position of an earlier one",
            "vertices at the position of earlier ones", "welded for the bake, kept in the output", "vertices");
  return lines.take();
}

std::string describeShape(const MeshCheck& check) {
  std::string line = counted(check.vertices, "vertex", "vertices") + ", " + counted(check.faces, "face", "faces");
  if (check.parts == 0) return line;
  line += ", " + counted(check.parts, "part", "parts");
  if (check.closedParts == 0) {
    line += check.parts == 1 ? ", open" : ", all open";
  } else if (check.closed()) {
    line += check.parts == 1 ? ", closed" : ", all closed";
  } else {
    line += ", " + std::to_string(check.closedParts) + " of them closed";
  }
  if (check.eulerCharacteristic) line += ", Euler characteristic " + std::to_string(*check.eulerCharacteristic);
  return line;
}

}  // namespace shbake
