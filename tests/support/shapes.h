// Meshes for tests and benchmarks, generated: everything below in one header.
#pragma once

#include "support/defects.h"
#include "support/scenes.h"
#include "support/surfaces.h"
#include "support/transforms.h"
