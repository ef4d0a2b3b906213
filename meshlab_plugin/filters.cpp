// Bake, refine, relight, save and load, as MeshLab calls them.
#include "meshlab_plugin/filters.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/background.h"
#include "meshlab_plugin/parameters.h"

namespace shbake::meshlab {
namespace {

/// "tracing: 1.5 of 4.2 million rays" is more than a status bar needs: the stage and the share are enough.
ProgressCallback pollWith(const Watch& watch) {
  return [&watch](const ProgressState& state) {
    const int percent = state.total > 0 ? static_cast<int>(std::lround(100 * state.done / state.total)) : 0;
    return watch(percent, state.stage.empty() ? "starting" : state.stage);
  };
}

MeshModel& currentLayer(MeshDocument& document) {
  MeshModel* layer = document.mm();
  if (layer == nullptr) throw usageError("there is no layer", "open a mesh first");
  return *layer;
}

/// Marks a filter as running for as long as it lives, which is longer than what the filter reads and makes: that memory
/// is handed back, since MeshLab stays open for hours.
class RunGuard {
 public:
  explicit RunGuard(bool& running) : running_(running) {
    if (running) throw usageError("shbake is still at work", "wait for its last filter to end, or cancel it");
    running = true;
  }
  ~RunGuard() {
    returnFreedMemory();
    running_ = false;
  }
  RunGuard(const RunGuard&) = delete;
  RunGuard& operator=(const RunGuard&) = delete;

 private:
  bool& running_;
};

std::string percentText(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

std::vector<std::string> describe(const AutoBake& bake) {
  const BakedMesh& baked = bake.baked;
  const TransferFacts& facts = baked.facts;
  std::vector<std::string> lines;
  lines.push_back("baked " + std::to_string(facts.lightingPoints) + " lighting points from " +
                  std::to_string(facts.sourceVertices) + " vertices, " + transferName(facts.kind) + ", order " +
                  std::to_string(baked.transfer.order) + ", " + std::to_string(facts.rays) + " rays each");
  lines.push_back("albedo: " + baked.albedoNote);
  for (const Choice& choice : bake.choices) {
    lines.push_back("chosen: " + choice.what + " " + choice.value + ": " + choice.reason);
  }
  if (facts.rays > 0) {
    lines.push_back("error: " + percentText(facts.rmsError) + " RMS, " + percentText(facts.maxError) + " at worst");
  }
  if (facts.surface.samples > 0) {
    lines.push_back("surface error: " + percentText(facts.surface.rms) + " RMS, between the vertices too");
  }
  const auto added = std::ranges::count(baked.sourceVertex, kNewVertex);
  if (added > 0) lines.push_back(std::to_string(added) + " vertices were added by refinement");
  const std::size_t split = baked.mesh.positions.size() - facts.sourceVertices - static_cast<std::size_t>(added);
  if (split > 0) lines.push_back(std::to_string(split) + " vertices were split off across creases");
  for (const std::string& warning : baked.warnings) lines.push_back("warning: " + warning);
  return lines;
}

std::vector<std::string> describe(const RefineReport& report) {
  const auto change = [](const std::array<std::size_t, 2>& counts) {
    return std::to_string(counts[1]) + ", from " + std::to_string(counts[0]);
  };
  const double share = report.area[0] > 0 ? report.flatArea / report.area[0] : 0;
  std::vector<std::string> lines;
  lines.push_back("flat: " + std::to_string(report.regions) + (report.regions == 1 ? " region, " : " regions, ") +
                  percentText(share) + " of the surface; " + std::to_string(report.refined) + " refined");
  for (const UnrefinedRegion& region : report.left) {
    lines.push_back("warning: flat region around face " + std::to_string(region.firstFace) + ": " +
                    std::to_string(region.faces) + (region.faces == 1 ? " face was" : " faces were") +
                    " left as before: " + region.reason);
  }
  lines.push_back("vertices: " + change(report.vertices));
  lines.push_back("faces: " + change(report.faces));
  return lines;
}

/// The surface in the layer's own axes, for the area that belongs to each vertex.
std::vector<double> areasOf(MeshModel& layer) {
  LayerSurface surface = readSurface(layer);
  Mesh mesh;
  for (const Vec3f& p : surface.positions) mesh.positions.emplace_back(p);
  mesh.triangles = std::move(surface.triangles);
  return vertexAreas(mesh);
}

}  // namespace

const std::vector<FilterText>& filterTexts() {
  static const std::vector<FilterText> texts{
      {Filter::bake, "SH Bake Light Transfer", "compute_sh_light_transfer_per_vertex",
       "Bakes how light reaches every vertex of the layer, with shadows and reflections, as spherical harmonics: "
       "precomputed radiance transfer. <b>SH Relight</b> then lights it with any distant light.<br>"
       "The vertex quality becomes the share of the sky that a vertex sees. Vertices on creases are split. Save the "
       "result with <b>SH Save Baked PLY</b>, or export it as .shply to open it here again.<br>See: <i>Peter-Pike "
       "Sloan, Jan Kautz, John Snyder</i>: <b>\"Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, "
       "Low-Frequency Lighting Environments\"</b>, SIGGRAPH 2002"},
      {Filter::refine, "SH Refine Flat Regions", "meshing_sh_refine_flat_regions",
       "Divides the flat regions of the layer into triangles with edges of about the length given, for light to be "
       "baked into their vertices: a wall of two triangles keeps no shadow on its middle. Curved parts, sharp edges, "
       "borders, colours, texture coordinates and all vertices stay as they are; new vertices come behind them.<br>"
       "A bake that the layer holds is dropped. <b>SH Bake Light Transfer</b> can also refine by itself, where the "
       "light changes."},
      {Filter::relight, "SH Relight", "apply_sh_light_per_vertex",
       "Colours the vertices of a baked layer with the light that they send out under a sky, a disc, an environment "
       "map "
       "or a light file. Tick Preview and drag the sliders to turn the light. Nothing but the vertex colours changes; "
       "the layer's own colours are kept beside them.<br>See:<br><i>Robin Green</i><br><b>\"Spherical Harmonic "
       "Lighting: The Gritty Details\"</b><br>GDC 2003"},
      {Filter::save, "SH Save Baked PLY", "save_sh_baked_ply",
       "Writes a baked layer as the PLY file that 'shbake bake' writes: vertices, normals, coefficients, stated errors "
       "and the facts needed to use them. Any viewer opens it; MeshLab itself drops the coefficients of a .ply file, "
       "so "
       "name it .shply to bake or relight it here again."}};
  return texts;
}

void declareParameters(Filter filter, const MeshModel* layer, RichParameterList& parameters) {
  switch (filter) {
    case Filter::bake:
      return declareBake(layer, parameters);
    case Filter::refine:
      return declareRefine(layer, parameters);
    case Filter::relight:
      return declareRelight(parameters);
    case Filter::save:
      return declareSave(parameters);
  }
}

int changesOf(Filter filter) {
  switch (filter) {
    case Filter::bake:
    case Filter::refine:
      return MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTNORMAL | MeshModel::MM_VERTNUMBER |
             MeshModel::MM_FACEVERT | MeshModel::MM_FACENORMAL | MeshModel::MM_FACENUMBER;
    case Filter::relight:
      return MeshModel::MM_VERTCOLOR;
    case Filter::save:
      break;
  }
  return MeshModel::MM_NONE;
}

std::vector<std::string> Filters::apply(Filter filter, MeshDocument& document, const RichParameterList& parameters,
                                        const Watch& watch) {
  const RunGuard guard(running_);
  if (filter == Filter::bake) return bake(document, parameters, watch);
  MeshModel& layer = currentLayer(document);
  if (filter == Filter::refine) return refineLayer(layer, parameters, watch);
  if (filter == Filter::relight) return relightLayer(layer, parameters, watch);
  const SaveChoice choice = saveChoice(parameters);
  write(choice.path, layer, choice.colors, choice.ascii, watch);
  return {"wrote " + choice.path};
}

std::vector<std::string> Filters::bake(MeshDocument& document, const RichParameterList& parameters,
                                       const Watch& watch) {
  BakeChoice choice = bakeChoice(parameters);
  MeshModel& layer = currentLayer(document);
  LayerMesh read = readLayer(layer);
  carryAttributes(layer, read);
  // Normals that are to be made anew must not keep flat regions apart.
  if (choice.options.points.normals != NormalSource::automatic) read.mesh.vertexNormals.clear();
  std::vector<Mesh> blockers;
  if (choice.otherLayers) {
    for (MeshModel* other : layersOf(document)) {
      if (other != &layer && other->isVisible() && other->cm.fn > 0) blockers.push_back(readLayer(*other).mesh);
    }
  }
  AutoBake bake;
  std::vector<std::string> notes;
  runInBackground(
      [&](Progress& progress) {
        const Parallel parallel(choice.threads);
        if (choice.light) {
          choice.automatic.light = lights_.make(*choice.light, LightOrder::kMost, parallel, progress, notes);
        }
        bake = autoBake(read.mesh, blockers, choice.options, choice.automatic, parallel, progress);
      },
      pollWith(watch));
  storeBake(layer, read, bake.baked, choice.preview);
  const std::vector<std::string> lines = describe(bake);
  notes.insert(notes.end(), lines.begin(), lines.end());
  return notes;
}

std::vector<std::string> Filters::refineLayer(MeshModel& layer, const RichParameterList& parameters,
                                              const Watch& watch) {
  const RefineChoice choice = refineChoice(parameters);
  LayerMesh read = readLayer(layer, Axes::own);
  carryAttributes(layer, read);
  if (!choice.keepNormals) read.mesh.vertexNormals.clear();
  RefinedMesh refined;
  runInBackground(
      [&](Progress& progress) {
        const Parallel parallel(choice.threads);
        const auto length = [&](std::uint32_t, const Vec3d&) { return choice.length; };
        refined = refineFlatRegions(read.mesh, choice.options, length, parallel, progress);
      },
      pollWith(watch));
  std::vector<std::string> lines = describe(refined.report);
  if (refined.report.refined == 0) {
    lines.emplace_back("the layer is as it was");
    return lines;
  }
  if (holdsTransfer(layer)) lines.emplace_back("the light that was baked has been dropped: bake the layer again");
  storeRefined(layer, read, refined.mesh);
  return lines;
}

std::vector<std::string> Filters::relightLayer(MeshModel& layer, const RichParameterList& parameters,
                                               const Watch& watch) {
  RelightChoice choice = relightChoice(parameters);
  const StoredTransfer stored = readTransfer(layer);
  std::vector<std::string> notes;
  std::vector<Rgb> radiance;
  runInBackground(
      [&](Progress& progress) {
        const Parallel parallel;
        Light light = lights_.make(choice.light, stored.transfer.order, parallel, progress, notes);
        // The transfer is in the axes of the bake: the light must be, too.
        if (stored.turn != sh::Matrix3d{}) light = rotated(light, sh::transposed(stored.turn));
        radiance = relight(stored.transfer, light, {}, parallel);
      },
      pollWith(watch));
  if (choice.automaticExposure) choice.tone.exposure += automaticExposure(radiance, areasOf(layer));
  std::vector<ByteColor> colors;
  colors.reserve(radiance.size());
  for (const Rgb& r : radiance) {
    const Rgb d = displayLight(r, choice.tone);
    colors.push_back({encodedByte(d.x), encodedByte(d.y), encodedByte(d.z)});
  }
  showColors(layer, stored.vertexPlaces, colors);
  char exposure[64];
  std::snprintf(exposure, sizeof exposure, "exposure: %.3g EV", choice.tone.exposure);
  notes.emplace_back(exposure);
  return notes;
}

void Filters::write(const std::string& path, MeshModel& layer, SavedColors colors, bool ascii, const Watch& watch) {
  const BakedPly baked = readBakedLayer(layer, colors);
  runInBackground(
      [&](Progress& progress) {
        writeBakedPly(path, baked.mesh, baked.transfer, baked.facts, baked.sourceVertex, {ascii}, progress);
      },
      pollWith(watch));
}

int Filters::load(const std::string& path, MeshModel& layer, const Watch& watch) {
  const RunGuard guard(running_);
  BakedPly baked;
  runInBackground([&](Progress& progress) { baked = readBakedPly(path, progress); }, pollWith(watch));
  return fillLayer(layer, baked);
}

void Filters::save(const std::string& path, MeshModel& layer, bool ascii, const Watch& watch) {
  const RunGuard guard(running_);
  write(path, layer, SavedColors::own, ascii, watch);
}

std::string describeFailure(const std::exception& failure) {
  if (dynamic_cast<const std::bad_alloc*>(&failure) != nullptr) return "there is not enough memory";
  const auto* error = dynamic_cast<const Error*>(&failure);
  if (error != nullptr && error->kind() == ErrorKind::cancelled) return "stopped; nothing has been changed";
  return failure.what();
}

}  // namespace shbake::meshlab
