// `shbake bake`: a mesh in, the mesh with its light transfer out.
#include <algorithm>
#include <filesystem>

#include "cli/describe_transfer.h"
#include "cli/format.h"
#include "cli/options.h"
#include "cli/output_path.h"
#include "cli/parse.h"
#include "cli/surface_option.h"
#include "cli/verb.h"
#include "cli/view_light.h"

namespace shbake::cli {
namespace {

namespace fs = std::filesystem;

class Bake : public Verb {
 public:
  void declare(CLI::App& app) override;
  void run(Session& session) override;

 private:
  void declareTransfer(CLI::App& app);
  void declareSurface(CLI::App& app);
  void declareAutomatic(CLI::App& app);
  AutoBakeOptions automatic(Session& session);
  void checkPaths() const;
  void warnOfIdleOptions(Session& session) const;
  void describe(const AutoBake& bake, const std::vector<std::string>& findings, Session& session) const;

  std::string mesh_, output_;
  std::vector<std::string> blockers_;
  BakeMeshOptions options_;
  RefinementOptions refinement_;
  double surfaceTolerance_ = options_.bake.tolerance;
  std::string light_;
  BakedPlyOptions ply_;
  bool force_ = false;
  CLI::Option *rays_ = nullptr, *tolerance_ = nullptr, *bounces_ = nullptr, *seed_ = nullptr, *crease_ = nullptr,
              *fit_ = nullptr, *transfer_ = nullptr, *order_ = nullptr, *refine_ = nullptr;
};

void Bake::declare(CLI::App& app) {
  addFile(app, "MESH", mesh_, "the mesh to bake: PLY, OBJ, OFF or STL");
  addText(app, {"-o,--output", "FILE", "the PLY file to write; required"}, output_);
  declareAutomatic(app);
  declareTransfer(app);
  declareSurface(app);
  addSurfaceSamples(app, "--surface-error",
                    "measure the error between the vertices too, at random points of the surface",
                    "shbake bake MESH -o OUT.ply --surface-error", options_.surfaceSamples);
  addSwitch(app, "--ascii", ply_.ascii, "write the file as text instead of binary");
  addSwitch(app, "--force", force_, "let the output replace the mesh that is baked or a blocker");
}

void Bake::declareAutomatic(CLI::App& app) {
  tolerance_ = addOption(
      app,
      {"--tolerance", "E",
       "surface error to reach, 0.0001..1: RMS over the surface, relative to the unshadowed "
       "transfer. Chooses transfer, vertices, rays and fit, as far as no option says otherwise"},
      "none: an error of 1 % at the vertices",
      [this](const std::string& name, const std::string& text) { surfaceTolerance_ = parseReal(name, text, 1e-4, 1); });
  addOption(
      app,
      {"--light", "LIGHT",
       "bake no more bands than pictures under this light need: a sky (overcast, clear or partly-cloudy), white, a "
       ".shlight file, or an image of an environment map"},
      "none: --order says how many", [this](const std::string&, const std::string& text) { light_ = text; });
  refine_ = addOption(app,
                      {"--refine", "LENGTH",
                       "divide flat parts into edges of this length first, in the file's units; auto: where the light "
                       "on them changes; no: nowhere"},
                      "no, or auto with --tolerance", [this](const std::string& name, const std::string& text) {
                        using Kind = RefinementOptions::Kind;
                        refinement_.kind = text == "no" ? Kind::none : text == "auto" ? Kind::automatic : Kind::length;
                        if (refinement_.kind != Kind::length) return;
                        refinement_.length = parseReal(name, text, std::numeric_limits<double>::min(), 1e300);
                      });
  addReal(app, {"--flat", "DEG", "what --refine takes for flat: faces within this angle of a plane, 0..45 degrees"},
          refinement_.flatDegrees, 0, 45);
  addWhole(app, {"--max-vertices", "N", "vertices that --refine may make, 1..700000000"}, refinement_.maxVertices, 1,
           700'000'000);
}

void Bake::declareTransfer(CLI::App& app) {
  BakeOptions& bake = options_.bake;
  transfer_ = addChoice<TransferKind>(
      app, {"--transfer", "KIND", "unshadowed (closed form), shadowed, or interreflected"}, bake.kind,
      {{"unshadowed", TransferKind::unshadowed},
       {"shadowed", TransferKind::shadowed},
       {"interreflected", TransferKind::interreflected}});
  order_ = addWhole(app, {"--order", "N", "bands of spherical harmonics, 1..8: N x N coefficients a channel"},
                    bake.order, 1, 8);
  rays_ = addOption(app, {"--rays", "N", "rays a point, 1..1048576, rounded up to a multiple of 16"},
                    "as many as the tolerance needs, or an error of 1 % at the vertices",
                    [&bake](const std::string& name, const std::string& text) {
                      bake.rays = static_cast<int>(parseWhole(name, text, 1, 1 << 20));
                    });
  bounces_ = addOption(
      app, {"--bounces", "N", "reflections to sum, 0..10000, or auto: until what is left is lost in the error"}, "auto",
      [&bake](const std::string& name, const std::string& text) {
        bake.bounces = text == "auto" ? BakeOptions::kBouncesAuto : static_cast<int>(parseWhole(name, text, 0, 10000));
      });
  addOption(app, {"--max-distance", "D", "faces farther away than this, in the file's units, are not seen"}, "no limit",
            [&bake](const std::string& name, const std::string& text) {
              bake.maxDistance = parseReal(name, text, std::numeric_limits<double>::min(), 1e300);
            });
  seed_ = addWhole(app, {"--seed", "N", "another number of 0 or more takes another sample of directions"}, bake.seed, 0,
                   std::numeric_limits<std::int64_t>::max());
  addOption(app, {"--memory", "BYTES", "memory for stored hits, such as 512M or 4G; never changes the result"},
            "half of what is free",
            [&bake](const std::string& name, const std::string& text) { bake.memory = parseBytes(name, text); });
}

void Bake::declareSurface(CLI::App& app) {
  fit_ = addChoice<FitKind>(
      app,
      {"--fit", "KIND",
       "vertex: the transfer at the vertices; surface: what interpolates best between them, in about twice the time; "
       "auto: fitted or smoothed where samples show that it helps"},
      options_.fit.kind,
      {{fitName(FitKind::automatic), FitKind::automatic},
       {fitName(FitKind::vertex), FitKind::vertex},
       {fitName(FitKind::surface), FitKind::surface}});
  addSwitch(app, "--two-sided", options_.bake.twoSided, "faces reflect from both sides (they block from both anyway)");
  addList(app, {"--blockers", "FILE...", "meshes that cast shadows and reflect but are not baked themselves"},
          blockers_);
  AlbedoOptions& albedo = options_.albedo;
  addOption(app,
            {"--albedo", "A",
             "share of light that is reflected: R or R,G,B, linear, 0..1; vertex or face: the file's colours; auto: "
             "these where it has them, else 0.8"},
            "auto", [&albedo](const std::string& name, const std::string& text) {
              if (text == "auto" || text == "vertex" || text == "face") {
                albedo.source = text == "auto"     ? AlbedoSource::automatic
                                : text == "vertex" ? AlbedoSource::vertex
                                                   : AlbedoSource::face;
                return;
              }
              albedo.source = AlbedoSource::uniform;
              albedo.uniform = parseRgb(name, text);
            });
  addChoice<bool>(app,
                  {"--albedo-space", "SPACE", "what 8-bit colours of the file are: srgb (display values) or linear"},
                  albedo.bytesAreLinear, {{"srgb", false}, {"linear", true}});
  addChoice<NormalSource>(
      app,
      {"--normals", "KIND", "auto: the file's where it has them, else smooth; smooth: made anew; flat: the faces'"},
      options_.points.normals,
      {{"auto", NormalSource::automatic}, {"smooth", NormalSource::smooth}, {"flat", NormalSource::flat}});
  crease_ =
      addReal(app, {"--crease", "DEG", "faces that meet at more than this angle, 0..180 degrees, share no normal"},
              options_.points.creaseDegrees, 0, 180);
}

/// Refuses outputs that cannot be meant, before any work is done.
void Bake::checkPaths() const {
  const std::string usage = "usage: shbake bake MESH -o OUT.ply";
  if (mesh_.empty()) {
    throw usageError("no mesh is named", blockers_.empty() ? usage : usage + "; the mesh comes before --blockers");
  }
  if (output_.empty()) throw usageError("no output is named", usage);
  requirePlyName(output_, "bake");
  std::vector<std::string> inputs = blockers_;
  inputs.push_back(mesh_);
  checkOutput(output_, inputs, "the mesh it is baked from", force_);
}

void Bake::warnOfIdleOptions(Session& session) const {
  const TransferKind kind = options_.bake.kind;
  const std::string with = std::string(" has no effect with --transfer ") + transferName(kind);
  if (kind == TransferKind::unshadowed) {
    if (isGiven(fit_)) session.warn("--fit" + with);
    if (isGiven(rays_)) session.warn("--rays" + with);
    if (isGiven(seed_)) session.warn("--seed" + with);
    if (!blockers_.empty()) session.warn("--blockers" + with);
  }
  if (kind != TransferKind::interreflected && isGiven(bounces_)) session.warn("--bounces" + with);
  if (options_.points.normals == NormalSource::flat && isGiven(crease_)) {
    session.warn("--crease has no effect with --normals flat");
  }
}

/// What is left for the bake to choose.
AutoBakeOptions Bake::automatic(Session& session) {
  AutoBakeOptions choose;
  choose.refinement = refinement_;
  if (isGiven(tolerance_)) {
    choose.tolerance = surfaceTolerance_;
    choose.transfer = !isGiven(transfer_);
    if (!isGiven(refine_)) choose.refinement.kind = RefinementOptions::Kind::automatic;
    if (!isGiven(fit_)) options_.fit.kind = FitKind::automatic;
  }
  if (light_.empty()) return choose;
  if (isGiven(order_)) {
    session.warn("--light has no effect with --order");
    return choose;
  }
  ViewLightOptions light;
  light.name = light_;
  const ViewLight view = light.make(LightOrder::kMost, false, session);
  if (view.rig) {
    throw Error({.kind = ErrorKind::usage,
                 .file = light_,
                 .cause = "a rig of local lights has no order of its own",
                 .remedy = "name one of its lights, or say --order"});
  }
  choose.light = view.light;
  return choose;
}

void Bake::run(Session& session) {
  checkPaths();
  warnOfIdleOptions(session);
  Mesh mesh = readMesh(mesh_, session.progress);
  const std::vector<std::string> findings = describeFindings(checkMesh(mesh, session.progress));
  std::vector<Mesh> blockers;
  for (const std::string& path : blockers_) blockers.push_back(readMesh(path, session.progress));
  const AutoBakeOptions choose = automatic(session);
  const AutoBake bake = autoBake(std::move(mesh), blockers, options_, choose, session.parallel, session.progress);
  const BakedMesh& baked = bake.baked;
  writeBakedPly(output_, baked.mesh, baked.transfer, baked.facts, baked.sourceVertex, ply_, session.progress);
  session.display.finish();
  for (const std::string& sentence : baked.warnings) session.warn(sentence);
  describe(bake, findings, session);
}

/// The times of the stages as one line, longest first, those below a hundredth of a second left out. Stages that came
/// more than once are added up.
std::string describeStages(const std::vector<ProgressDisplay::Stage>& stages) {
  std::vector<std::pair<std::string, double>> times;
  for (const auto& stage : stages) {
    const auto same = std::find_if(times.begin(), times.end(), [&](const auto& t) { return t.first == stage.name; });
    if (same == times.end()) {
      times.emplace_back(stage.name, stage.seconds);
    } else {
      same->second += stage.seconds;
    }
  }
  std::stable_sort(times.begin(), times.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, seconds] : times) {
    if (seconds < 0.01) break;
    text += (text.empty() ? "" : ", ") + name + " " + formatDuration(seconds);
  }
  return text;
}

/// Adds how long the work took and how fast rays were traced.
void describeTime(Session& session) {
  double seconds = 0, rays = 0, tracing = 0;
  for (const auto& stage : session.display.stages()) {
    seconds += stage.seconds;
    if (stage.unit != "rays") continue;
    rays += stage.done;
    tracing += stage.seconds;
  }
  Report& report = session.report;
  const std::string stages = describeStages(session.display.stages());
  report.fact("seconds", seconds, "time", formatDuration(seconds) + (stages.empty() ? "" : " (" + stages + ")"));
  report.data("traced_rays", rays);
  report.data("peak_memory", static_cast<std::int64_t>(peakMemory()));
  const int threads = session.parallel.threads();
  report.data("threads", std::int64_t(threads));
  if (rays > 0 && tracing > 0) {
    report.line("rate", formatShort(rays / tracing) + " rays/s on " + std::to_string(threads) +
                            (threads == 1 ? " thread" : " threads"));
  }
}

/// Adds one line for each choice that the bake made.
void describeChoices(const AutoBake& bake, Report& report) {
  bool first = true;
  for (const Choice& choice : bake.choices) {
    report.data("choices." + choice.what + ".value", choice.value);
    report.data("choices." + choice.what + ".reason", choice.reason);
    report.line(first ? "chosen" : "", choice.what + " " + choice.value + ": " + choice.reason);
    first = false;
  }
}

void Bake::describe(const AutoBake& bake, const std::vector<std::string>& findings, Session& session) const {
  const BakedMesh& baked = bake.baked;
  const TransferFacts& facts = baked.facts;
  Report& report = session.report;
  const auto whole = [](std::size_t n) { return static_cast<std::int64_t>(n); };

  report.data("input.file", mesh_);
  report.data("input.vertices", whole(facts.sourceVertices));
  report.fact(
      "output.points", whole(facts.lightingPoints), "points",
      formatCount(facts.lightingPoints) + " lighting points, from " + formatCount(facts.sourceVertices) + " vertices");
  report.data("input.findings", findings);
  for (std::size_t i = 0; i < findings.size(); ++i) report.line(i == 0 ? "check" : "", findings[i]);
  report.fact("albedo", baked.albedoNote, "albedo", baked.albedoNote);
  describeChoices(bake, report);
  describeTransfer(baked.transfer, &facts, report);
  if (baked.fit) report.data("fit.reason", baked.fit->reason);
  describeTime(session);
  report.data("output.file", output_);
  report.data("output.vertices", whole(baked.transfer.size()));
  std::error_code none;
  const auto size = fs::is_regular_file(output_, none) ? fs::file_size(output_, none) : 0;
  report.fact("output.bytes", whole(size), "output", output_ + (size > 0 ? ", " + formatBytes(double(size)) : ""));
}

}  // namespace

extern const VerbEntry bakeVerb;
const VerbEntry bakeVerb{
    "bake", "MESH -o FILE", "bake light transfer into the vertices of a mesh",
    "Bakes how light reaches every vertex of MESH, with shadows and reflections, as spherical harmonics that turn any "
    "distant light into radiance, and writes the mesh with them as a PLY file.\n"
    "\n"
    "Examples:\n"
    "  shbake bake bunny.obj -o bunny.ply\n"
    "  shbake bake city.ply -o city_sh.ply --transfer shadowed --rays 1024",
    [] { return std::unique_ptr<Verb>(std::make_unique<Bake>()); }};

}  // namespace shbake::cli
