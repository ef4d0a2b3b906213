// Parameters of the filters that bake and refine.
#include "meshlab_plugin/parameters.h"

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "meshlab_plugin/api.h"
#include "meshlab_plugin/parameter_values.h"

namespace shbake::meshlab {
namespace {

constexpr int kMostMegabytes = 1 << 20;
/// The default length of edges, in diagonals of the layer's box: a square wall gets about 1500 vertices.
constexpr float kUsualLength = 0.02f;

void declareRays(RichParameterList& p) {
  p.addParam(
      RichInt("order", 4, "Order",
              "Bands of spherical harmonics, 1 to 8: order n keeps n x n coefficients a vertex and channel. 3 is "
              "enough for soft light; 5 and more keep the edges of shadows. Not used with an order by light."));
  p.addParam(RichString("light", "", "Order by light",
                        "Bake no more bands than pictures under this light need, to the tolerance or to 2 %: overcast, "
                        "clear, partly-cloudy (skies of the CIE), white, or the whole path of an image of an "
                        "environment map or of a .shlight file. Empty: the order above."));
  p.addParam(
      RichInt("rays", 0, "Rays",
              "Rays a vertex, up to 1048576, rounded up to a multiple of 16. 0: as many as the tolerance needs, or an "
              "error of 1 % at the vertices."));
  p.addParam(RichInt("bounces", -1, "Reflections",
                     "How many reflections to sum, 0 to 10000. -1: until what is left is lost in the error."));
  p.addParam(RichFloat("max_distance", 0.0f, "Maximum distance",
                       "Faces farther away than this are not seen, in the units of the mesh. 0: no limit."));
  p.addParam(RichInt("seed", 1, "Seed", "Another number of 0 or more takes another sample of directions."));
}

/// What the bake chooses by itself where it has a tolerance to meet.
constexpr const char* kByTolerance = "By tolerance";

void declareAutomatic(RichParameterList& p) {
  p.addParam(
      RichFloat("tolerance", 0.0f, "Tolerance",
                "The error of the surface to reach, 0.0001 to 1: RMS over the surface, between the vertices too, "
                "relative to the unshadowed transfer; 0.02 is two per cent. Whatever is left to be chosen by tolerance "
                "below is, and so are the rays where none are given. 0: none; the vertices get an error of 1 %."));
  p.addParam(
      RichEnum("transfer", 3,
               QStringList() << "Unshadowed"
                             << "Shadowed"
                             << "Interreflected" << kByTolerance,
               "Transfer",
               "How much of the light's way counts: the cosine alone (in closed form), shadows too, or shadows and "
               "the reflections between parts of the mesh. By tolerance: interreflected; with a tolerance, less where "
               "that gives the same."));
  p.addParam(
      RichEnum("fit", 3,
               QStringList() << "Vertex"
                             << "Surface"
                             << "Automatic" << kByTolerance,
               "Fit",
               "Vertex: the transfer at the vertices. Surface: what interpolates best between them, in about twice the "
               "time. Automatic: fitted or smoothed where samples show that it helps. By tolerance: automatic with a "
               "tolerance, else vertex."));
}

/// What refinement is told of flat regions; `most` is the default of its vertex limit.
void declareFlat(RichParameterList& p, int most) {
  p.addParam(RichFloat("flat", static_cast<float>(RefineOptions{}.flatDegrees), "Flat angle",
                       "Faces within this angle of a plane, 0 to 45 degrees, make a flat region. It decides only which "
                       "faces may be divided: shape and normals never change."));
  p.addParam(RichInt("max_vertices", most, "Most vertices",
                     "Vertices that refinement may make of the layer in all, 1 to 700000000."));
}

/// The length of edges, with `diagonal` as what per cent are of.
void declareLength(RichParameterList& p, const char* name, double diagonal, const char* help) {
  const auto whole = static_cast<float>(diagonal);
  p.addParam(LengthParameter(name, whole * kUsualLength, 0.0f, whole, "Edge length", help));
}

void declareRefinement(RichParameterList& p, double diagonal) {
  p.addParam(RichEnum("refine", 3,
                      QStringList() << "Nowhere"
                                    << "To the edge length"
                                    << "Where the light changes" << kByTolerance,
                      "Refine flat regions",
                      "Light is baked into vertices: a wall of two triangles keeps no shadow on its middle. The layer "
                      "gets more vertices where it is flat, evenly or where the light on it changes, to an error of "
                      "2 % or to the tolerance. By tolerance: where the light changes, if there is a tolerance."));
  declareLength(p, "refine_length", diagonal,
                "What edges in flat regions are divided to, where that is chosen; in the units of the scene, after the "
                "layer's transform.");
  declareFlat(p, static_cast<int>(RefinementOptions{}.maxVertices));
}

void declareSurface(RichParameterList& p) {
  p.addParam(RichBool("two_sided", false, "Two-sided faces",
                      "Faces reflect from both sides. They block light from both sides in any case."));
  p.addParam(RichBool("other_layers", true, "Other visible layers count",
                      "Other visible layers cast shadows on this one and reflect onto it, without being baked."));
  p.addParam(
      RichEnum("albedo", 0,
               QStringList() << "Colours where there are any, else uniform"
                             << "Uniform"
                             << "Vertex colours"
                             << "Face colours",
               "Albedo from",
               "The share of light that the surface reflects. Colours are those that the layer had before shbake "
               "showed it baked or relit."));
  p.addParam(RichString("albedo_uniform", "0.8", "Uniform albedo",
                        "Linear, 0 to 1: one number, or red, green and blue with commas, such as 0.8,0.5,0.3."));
  p.addParam(RichBool("linear_colors", false, "Colours are linear",
                      "Take 8-bit colours as linear albedo. Otherwise they are display values and sRGB-decoded."));
  p.addParam(
      RichEnum("normals", 1,
               QStringList() << "Those of the layer"
                             << "Smooth, split at creases"
                             << "Flat",
               "Normals",
               "Smooth normals are made anew from the faces that meet in a vertex; vertices on a crease are split, "
               "so that each side has its own light. Flat gives every face vertices of its own."));
  p.addParam(RichFloat("crease", 50.0f, "Crease angle",
                       "Faces that meet at more than this angle share no smooth normal, 0 to 180 degrees."));
}

double flatDegreesOf(const RichParameterList& p) {
  return realOf(p, "flat", "Flat angle", 0, 45);
}

std::size_t mostVerticesOf(const RichParameterList& p) {
  return static_cast<std::size_t>(wholeOf(p, "max_vertices", "Most vertices", 1, 700'000'000));
}

/// What is left for the bake to choose, as the program decides without the option; the rest is set in `options`.
AutoBakeOptions automaticOf(const RichParameterList& p, BakeMeshOptions& options) {
  using Refinement = RefinementOptions::Kind;
  AutoBakeOptions choose;
  if (p.getFloat("tolerance") != 0) choose.tolerance = realOf(p, "tolerance", "Tolerance", 1e-4, 1);
  const bool open = choose.tolerance.has_value();
  const auto kind = choiceOf<std::optional<TransferKind>>(
      p, "transfer", "Transfer",
      {TransferKind::unshadowed, TransferKind::shadowed, TransferKind::interreflected, std::nullopt});
  options.bake.kind = kind.value_or(TransferKind::interreflected);
  choose.transfer = open && !kind;
  options.fit.kind = choiceOf<std::optional<FitKind>>(
                         p, "fit", "Fit", {FitKind::vertex, FitKind::surface, FitKind::automatic, std::nullopt})
                         .value_or(open ? FitKind::automatic : FitKind::vertex);
  RefinementOptions& refinement = choose.refinement;
  refinement.kind =
      choiceOf<std::optional<Refinement>>(p, "refine", "Refine flat regions",
                                          {Refinement::none, Refinement::length, Refinement::automatic, std::nullopt})
          .value_or(open ? Refinement::automatic : Refinement::none);
  if (refinement.kind == Refinement::length) refinement.length = lengthOf(p, "refine_length", "Edge length");
  refinement.flatDegrees = flatDegreesOf(p);
  refinement.maxVertices = mostVerticesOf(p);
  return choose;
}

/// The light that pictures are to be made under, where it is to say how many bands are baked.
std::optional<LightChoice> lightForOrder(const RichParameterList& p) {
  const std::string name = p.getString("light").toStdString();
  if (name.empty()) return std::nullopt;
  static const std::map<std::string, LightKind> kinds{{"overcast", LightKind::overcast},
                                                      {"clear", LightKind::clear},
                                                      {"partly-cloudy", LightKind::partlyCloudy},
                                                      {"white", LightKind::white}};
  LightChoice light;
  const auto known = kinds.find(name);
  light.kind = known != kinds.end() ? known->second : LightKind::file;
  light.file = name;
  return light;
}

/// What lengths of a layer are compared with: the diagonal of the box around it; 1 where it has none.
double diagonalOf(const MeshModel* layer, Axes axes) {
  if (layer == nullptr || layer->cm.bbox.IsNull()) return 1;
  const auto diagonal = static_cast<double>(axes == Axes::world ? layer->cm.trBB().Diag() : layer->cm.bbox.Diag());
  return diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1;
}

}  // namespace

void declareBake(const MeshModel* layer, RichParameterList& p) {
  declareAutomatic(p);
  declareRays(p);
  declareRefinement(p, diagonalOf(layer, Axes::world));
  declareSurface(p);
  p.addParam(RichInt("surface_samples", 0, "Surface samples",
                     "Random places of the surface at which the error between the vertices is measured after the bake, "
                     "16 to 1048576. 0: only where a tolerance asks for it."));
  p.addParam(RichBool("preview", true, "Show the visible sky as grey",
                      "Colour the vertices by the share of the sky that they see. The layer's own colours are kept for "
                      "albedo and for saving."));
  p.addParam(RichInt("threads", 0, "Threads", "Threads to bake with, 0 to 1024. 0: all cores."));
  p.addParam(RichInt("memory", 0, "Memory (MB)",
                     "Megabytes for stored hits; never changes the result. 0: half of what is free."));
}

BakeChoice bakeChoice(const RichParameterList& p) {
  BakeChoice choice;
  choice.light = lightForOrder(p);
  BakeOptions& bake = choice.options.bake;
  choice.automatic = automaticOf(p, choice.options);
  bake.order = wholeOf(p, "order", "Order", 1, 8);
  bake.rays = wholeOf(p, "rays", "Rays", 0, 1 << 20);
  bake.bounces = wholeOf(p, "bounces", "Reflections", BakeOptions::kBouncesAuto, 10000);
  const double distance = realOf(p, "max_distance", "Maximum distance", 0, std::numeric_limits<float>::max());
  if (distance > 0) bake.maxDistance = distance;
  bake.seed = static_cast<std::uint64_t>(wholeOf(p, "seed", "Seed", 0, std::numeric_limits<int>::max()));
  bake.twoSided = p.getBool("two_sided");
  bake.memory = static_cast<std::size_t>(wholeOf(p, "memory", "Memory", 0, kMostMegabytes)) << 20;
  AlbedoOptions& albedo = choice.options.albedo;
  albedo.source = choiceOf<AlbedoSource>(
      p, "albedo", "Albedo from",
      {AlbedoSource::automatic, AlbedoSource::uniform, AlbedoSource::vertex, AlbedoSource::face});
  albedo.uniform = sharesOf(p, "albedo_uniform", "Uniform albedo");
  albedo.bytesAreLinear = p.getBool("linear_colors");
  if (p.getInt("surface_samples") != 0) {
    choice.options.surfaceSamples =
        static_cast<std::size_t>(wholeOf(p, "surface_samples", "Surface samples", SurfaceErrorOptions::kLeastSamples,
                                         SurfaceErrorOptions::kMostSamples));
  }
  choice.options.points.normals = choiceOf<NormalSource>(
      p, "normals", "Normals", {NormalSource::automatic, NormalSource::smooth, NormalSource::flat});
  choice.options.points.creaseDegrees = realOf(p, "crease", "Crease angle", 0, 180);
  choice.otherLayers = p.getBool("other_layers");
  choice.preview = p.getBool("preview");
  choice.threads = wholeOf(p, "threads", "Threads", 0, Parallel::kMostThreads);
  return choice;
}

void declareRefine(const MeshModel* layer, RichParameterList& p) {
  declareLength(p, "length", diagonalOf(layer, Axes::own),
                "The length that edges in flat regions are to have. Most come out between 0.7 and 1.4 of it.");
  declareFlat(p, static_cast<int>(RefineOptions{}.maxVertices));
  p.addParam(RichFloat("crease", static_cast<float>(RefineOptions{}.creaseDegrees), "Crease angle",
                       "Faces that meet at more than this angle, 0 to 180 degrees, share no normal: a region may end "
                       "there. Where faces meet at less, a curved surface goes on, and it is no flat region."));
  p.addParam(RichBool("keep_normals", false, "Keep normals",
                      "Take the normals of the layer for its shading: they stay, new vertices get them interpolated, "
                      "and edges stay at which they change. Otherwise all normals are made anew from the faces."));
  p.addParam(RichInt("threads", 0, "Threads", "Threads to refine with, 0 to 1024. 0: all cores."));
}

RefineChoice refineChoice(const RichParameterList& p) {
  RefineChoice choice;
  choice.length = lengthOf(p, "length", "Edge length");
  choice.options.flatDegrees = flatDegreesOf(p);
  choice.options.maxVertices = mostVerticesOf(p);
  choice.options.creaseDegrees = realOf(p, "crease", "Crease angle", 0, 180);
  choice.keepNormals = p.getBool("keep_normals");
  choice.threads = wholeOf(p, "threads", "Threads", 0, Parallel::kMostThreads);
  return choice;
}

}  // namespace shbake::meshlab
