// A baked mesh as it is drawn: alone, or on a ground plane that catches its shadow.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/view_light.h"
#include "shbake.h"

namespace shbake::cli {

struct Session;

class BakedScene {
 public:
  /// Reads a baked file; what was assumed in reading is warned of.
  BakedScene(const std::string& path, Session& session);

  /// Puts a plane of this albedo below the mesh (groundPlane()) and bakes it with the mesh around it, in the way in
  /// which the mesh was baked: without shadows, with the mesh's shadow, or with the light that the mesh reflects on it,
  /// too. The mesh itself stays as it was baked: the plane neither hides light from it nor sends it any.
  void addGround(const Rgb& albedo, UpAxis up, Session& session);

  const std::string& path() const { return path_; }
  const Mesh& mesh() const { return baked_.mesh; }
  const TransferSet& transfer() const { return baked_.transfer; }
  /// The name of its kind of transfer, where the file tells, else of the file.
  std::string title() const;
  /// Radiance of the mesh's vertices.
  std::vector<Rgb> colors(const ViewLight& light, const Parallel& parallel) const;

  /// What a camera sees: the mesh, then the plane where there is one and the camera is above it.
  struct Drawn {
    Mesh mesh;
    std::vector<Rgb> colors;
  };
  Drawn drawn(const ViewLight& light, const Camera& camera, const Parallel& parallel) const;

 private:
  std::string path_;
  BakedPly baked_;
  std::optional<BakedMesh> ground_;
};

}  // namespace shbake::cli
