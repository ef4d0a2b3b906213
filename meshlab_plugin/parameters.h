// The parameters of the filters as MeshLab shows them, and what they mean to shbake.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshlab_plugin/bridge.h"
#include "meshlab_plugin/light_choice.h"
#include "shbake.h"

class RichParameterList;

namespace shbake::meshlab {

/// What the bake filter is asked for.
struct BakeChoice {
  BakeMeshOptions options;
  AutoBakeOptions automatic;
  std::optional<LightChoice> light;  ///< whose pictures say how many bands are baked; else options.bake.order
  bool otherLayers = true;           ///< other visible layers cast shadows and reflect
  bool preview = true;               ///< show the visible share of the sky as grey
  int threads = 0;
};

/// What the refining filter is asked for.
struct RefineChoice {
  RefineOptions options;
  double length = 0;         ///< of edges, in the layer's own axes, > 0
  bool keepNormals = false;  ///< the layer's normals are its shading; else they are made anew
  int threads = 0;
};

/// What the relighting filter is asked for.
struct RelightChoice {
  LightChoice light;
  bool automaticExposure = true;  ///< the brightest 1 % become white before `tone.exposure` is added
  ToneMap tone;
};

/// What the saving filter is asked for.
struct SaveChoice {
  std::string path;
  SavedColors colors = SavedColors::own;
  bool ascii = false;
};

/// The format of baked files, as which MeshLab keeps their transfer.
inline constexpr const char* kFormatDescription = "Mesh with baked light transfer";
inline constexpr const char* kFormatExtension = "SHPLY";
/// The bits of vcg::tri::io::Mask that a baked file keeps of a layer.
extern const int kFormatMask;
void declareFormat(RichParameterList& parameters);
bool formatIsAscii(const RichParameterList& parameters);

/// Parameters with their defaults, labels and tooltips. Lengths are relative to `layer`, which may be null.
void declareBake(const MeshModel* layer, RichParameterList& parameters);
void declareRefine(const MeshModel* layer, RichParameterList& parameters);
void declareRelight(RichParameterList& parameters);
void declareSave(RichParameterList& parameters);

/// The choices that parameters make. Throw a usage error that names the first parameter out of its range.
BakeChoice bakeChoice(const RichParameterList& parameters);
RefineChoice refineChoice(const RichParameterList& parameters);
RelightChoice relightChoice(const RichParameterList& parameters);
SaveChoice saveChoice(const RichParameterList& parameters);

}  // namespace shbake::meshlab
