// The whole job in a few lines: read a mesh, bake it to a stated error, write it with its transfer.
//   bake_file room.obj room.ply
#include <cstdio>

#include "shbake.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: bake_file MESH OUT.ply\n");
    return 2;
  }
  try {
    // The callback may return false to stop the work.
    shbake::Progress progress([](const shbake::ProgressState& state) {
      if (state.done == state.total && state.total > 0) std::printf("%s: %.2f s\n", state.stage.c_str(), state.elapsed);
      return true;
    });
    const shbake::Parallel allCores;
    shbake::BakeMeshOptions options;
    options.bake.tolerance = 0.03;  // RMS over the surface, relative to the unshadowed transfer

    shbake::Mesh mesh = shbake::readMesh(argv[1], progress);
    const shbake::BakedMesh baked = shbake::bakeMesh(std::move(mesh), {}, options, allCores, progress);
    shbake::writeBakedPly(argv[2], baked.mesh, baked.transfer, baked.facts, baked.sourceVertex, {}, progress);

    std::printf("%zu vertices, %d rays a point, stated error %.2f %%\n", baked.transfer.size(), baked.facts.rays,
                100 * baked.facts.rmsError);
    return baked.facts.rmsError <= options.bake.tolerance ? 0 : 1;
  } catch (const shbake::Error& e) {
    std::fprintf(stderr, "bake_file: %s\n", e.what());
    return 1;
  }
}
