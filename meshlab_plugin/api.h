// MeshLab's source API: its headers, and one name for what its releases name differently. SHBAKE_MESHLAB_API is the
// release as yyyymm; 202009 is Debian 12's, whose classes differ most from those of 2021.05 and later.
#pragma once

#if SHBAKE_MESHLAB_API >= 202105
#include <common/ml_document/mesh_document.h>
#include <common/plugins/interfaces/filter_plugin.h>
#include <common/plugins/interfaces/io_plugin.h>
#else
#include <common/interfaces.h>
#endif

#if SHBAKE_MESHLAB_API >= 202312
#include <common/parameters/rich_parameter_list.h>
#endif

#include <vector>

namespace shbake::meshlab {

#if SHBAKE_MESHLAB_API >= 202312
using LengthParameter = RichPercentage;
using OpenFileParameter = RichFileOpen;
using SaveFileParameter = RichFileSave;
#else
using LengthParameter = RichAbsPerc;
using OpenFileParameter = RichOpenFile;
using SaveFileParameter = RichSaveFile;
#endif

/// All layers of a document, in its order.
inline std::vector<MeshModel*> layersOf(MeshDocument& document) {
  std::vector<MeshModel*> layers;
#if SHBAKE_MESHLAB_API >= 202107
  for (MeshModel& layer : document.meshIterator()) layers.push_back(&layer);
#else
  for (MeshModel* layer : document.meshList) layers.push_back(layer);
#endif
  return layers;
}

}  // namespace shbake::meshlab
