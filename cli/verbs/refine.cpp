// `shbake refine`: a mesh in, the mesh with more vertices in its flat regions out.
#include <array>
#include <limits>

#include "cli/format.h"
#include "cli/options.h"
#include "cli/output_path.h"
#include "cli/parse.h"
#include "cli/verb.h"

namespace shbake::cli {
namespace {

std::int64_t whole(std::size_t n) {
  return static_cast<std::int64_t>(n);
}

class Refine : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void checkPaths() const;
  void describe(const RefineReport& refined, Session& session) const;

  std::string mesh_, output_;
  double length_ = 0;
  RefineOptions options_;
  bool ascii_ = false, force_ = false;
};

void Refine::declare(CLI::App& app) {
  addFile(app, "MESH", mesh_, "the mesh to refine: PLY, OBJ, OFF or STL");
  addText(app, {"-o,--output", "FILE", "the PLY file to write; required"}, output_);
  addOption(app, {"--length", "L", "the length that edges in flat regions are to have, in the file's units; required"},
            "", [this](const std::string& name, const std::string& text) {
              length_ = parseReal(name, text, std::numeric_limits<double>::min(), 1e300);
            });
  addReal(app, {"--flat", "DEG", "faces within this angle of a region's plane belong to it, 0..45 degrees"},
          options_.flatDegrees, 0, 45);
  addReal(app, {"--crease", "DEG", "faces that meet at more than this angle, 0..180 degrees, share no normal"},
          options_.creaseDegrees, 0, 180);
  addWhole(app, {"--max-vertices", "N", "refuse to make more vertices than this, 1..700000000"}, options_.maxVertices,
           1, 700'000'000);
  addSwitch(app, "--ascii", ascii_, "write the file as text instead of binary");
  addSwitch(app, "--force", force_, "let the output replace the mesh that is refined");
}

/// Refuses outputs that cannot be meant, before any work is done.
void Refine::checkPaths() const {
  const std::string usage = "usage: shbake refine MESH -o OUT.ply --length L";
  if (mesh_.empty()) throw usageError("no mesh is named", usage);
  if (output_.empty()) throw usageError("no output is named", usage);
  if (length_ == 0) throw usageError("no length is given", usage);
  requirePlyName(output_, "refine");
  checkOutput(output_, std::array{mesh_}, "the mesh that is refined", force_);
}

void Refine::run(Session& session) {
  checkPaths();
  if (isBakedPly(mesh_)) {
    throw Error({.file = mesh_,
                 .cause = "the file is baked: light cannot be told at new vertices from the old ones",
                 .remedy = "refine the mesh that it was baked from, and bake that"});
  }
  Mesh mesh = readMesh(mesh_, session.progress);
  const RefinedMesh refined = refineFlatRegions(
      mesh, options_, [this](std::uint32_t, const Vec3d&) { return length_; }, session.parallel, session.progress);
  writePly(output_, refined.mesh, {ascii_ ? PlyEncoding::ascii : PlyEncoding::binaryLittleEndian}, session.progress);
  session.display.finish();
  for (const std::string& sentence : mesh.warnings) session.warn(sentence);
  describe(refined.report, session);
}

void Refine::describe(const RefineReport& refined, Session& session) const {
  Report& report = session.report;
  report.data("input.file", mesh_);
  report.data("length", length_);
  report.data("flat.faces", whole(refined.flatFaces));
  report.data("flat.area", refined.flatArea);
  report.data("regions.refined", whole(refined.refined));
  report.data("regions.left", whole(refined.left.size()));
  const double share = refined.area[0] > 0 ? refined.flatArea / refined.area[0] : 0;
  report.fact("regions.found", whole(refined.regions), "flat",
              formatCount(refined.regions) + (refined.regions == 1 ? " region, " : " regions, ") +
                  formatPercent(share) + " of the surface; " + formatCount(refined.refined) + " refined");
  for (const UnrefinedRegion& region : refined.left) {
    session.warn("flat region around face " + std::to_string(region.firstFace) + ": " + formatCount(region.faces) +
                 (region.faces == 1 ? " face was" : " faces were") + " left as before: " + region.reason);
  }
  const auto change = [&](const std::string& key, const std::string& label, const std::array<std::size_t, 2>& counts) {
    report.data(key + ".before", whole(counts[0]));
    report.fact(key + ".after", whole(counts[1]), label, formatCount(counts[1]) + ", from " + formatCount(counts[0]));
  };
  change("vertices", "vertices", refined.vertices);
  change("faces", "faces", refined.faces);
  report.data("area.before", refined.area[0]);
  report.fact("area.after", refined.area[1], "area", formatNumber(refined.area[1], 9));
  report.fact("output.file", output_, "output", output_);
}

}  // namespace

extern const VerbEntry refineVerb;
const VerbEntry refineVerb{"refine", "MESH -o FILE --length L", "give the flat parts of a mesh more vertices",
                           "Divides the flat regions of a mesh into triangles with edges of about the length given, "
                           "for light to be baked into "
                           "their vertices. Curved parts, sharp edges, borders, colours, normals, texture coordinates "
                           "and all vertices stay as "
                           "they are; new vertices come behind them.\n"
                           "\n"
                           "Examples:\n"
                           "  shbake refine room.obj -o fine.ply --length 0.1\n"
                           "  shbake bake fine.ply -o room.ply",
                           [] { return std::unique_ptr<Verb>(std::make_unique<Refine>()); }};

}  // namespace shbake::cli
