// What more rays buy: stated errors against the distance from a bake with many rays.
//   rays_and_error city.obj
#include <cmath>
#include <cstdio>

#include "shbake.h"

namespace {

shbake::BakedMesh bake(const shbake::Mesh& mesh, int rays, std::uint64_t seed) {
  shbake::Progress progress;
  shbake::BakeMeshOptions options;
  options.bake.kind = shbake::TransferKind::shadowed;
  options.bake.rays = rays;
  options.bake.seed = seed;
  return shbake::bakeMesh(mesh, {}, options, shbake::Parallel(), progress);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: rays_and_error MESH\n");
    return 2;
  }
  try {
    shbake::Progress progress;
    const shbake::Mesh mesh = shbake::readMesh(argv[1], progress);
    const shbake::BakedMesh reference = bake(mesh, 16384, 2);
    bool agree = true;
    std::printf("%6s %10s %10s\n", "rays", "stated", "true");
    for (const int rays : {64, 256, 1024}) {
      const shbake::BakedMesh baked = bake(mesh, rays, 1);
      const shbake::BakedPly a{baked.mesh, baked.transfer, baked.facts, true, {}, {}};
      const shbake::BakedPly b{reference.mesh, reference.transfer, reference.facts, true, {}, {}};
      const double error = shbake::compareTransfer(a, b, progress).rmsError;
      std::printf("%6d %8.2f %% %8.2f %%\n", rays, 100 * baked.facts.rmsError, 100 * error);
      agree &= std::abs(std::log(baked.facts.rmsError / error)) < std::log(1.5);
    }
    return agree ? 0 : 1;
  } catch (const shbake::Error& e) {
    std::fprintf(stderr, "rays_and_error: %s\n", e.what());
    return 1;
  }
}
