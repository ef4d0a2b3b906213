// One dot product a vertex and channel: how bright the vertices of a baked mesh are under an overcast sky.
//   light_vertex columns.obj
#include <algorithm>
#include <cstdio>

#include "shbake.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: light_vertex MESH\n");
    return 2;
  }
  try {
    shbake::Progress progress;
    shbake::BakeMeshOptions options;
    options.bake.rays = 256;
    const shbake::BakedMesh baked =
        shbake::bakeMesh(shbake::readMesh(argv[1], progress), {}, options, shbake::Parallel(), progress);

    const shbake::Light sky = shbake::skyLight(options.bake.order, {});  // CIE overcast, zenith radiance 1
    double darkest = 1e9, brightest = 0;
    for (std::size_t vertex = 0; vertex < baked.transfer.size(); ++vertex) {
      const auto transfer = baked.transfer.at(vertex, 0);
      double radiance = 0;
      for (std::size_t i = 0; i < transfer.size(); ++i) {
        radiance += static_cast<double>(transfer[i]) * sky.coefficients[i].x;
      }
      darkest = std::min(darkest, radiance);
      brightest = std::max(brightest, radiance);
    }
    std::printf("outgoing radiance from %.4f to %.4f of the zenith's\n", darkest, brightest);
    return darkest < brightest ? 0 : 1;
  } catch (const shbake::Error& e) {
    std::fprintf(stderr, "light_vertex: %s\n", e.what());
    return 1;
  }
}
