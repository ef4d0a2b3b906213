// The one header that programs outside the library include.
#pragma once

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/vec3.h"
#include "bake/bake_options.h"
#include "mesh/lighting_points.h"
#include "mesh/mesh.h"
#include "mesh/mesh_check.h"
#include "mesh/mesh_reader.h"
#include "pipeline/bake_mesh.h"
#include "sh/basis.h"
#include "transfer/baked_ply.h"
#include "transfer/compare.h"
#include "transfer/transfer_set.h"
