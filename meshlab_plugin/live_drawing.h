// Triangles with radiance at their vertices, drawn by OpenGL 2.1, which Mesa's software renderer has, too.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "meshlab_plugin/bridge.h"
#include "shbake.h"

namespace shbake::meshlab {

/// What the graphics card holds of one layer. To be made, drawn and destroyed with the same OpenGL context current.
class LayerDrawing {
 public:
  /// Throws an Error when the mesh is too large for the graphics card.
  explicit LayerDrawing(const LayerSurface& surface);
  ~LayerDrawing();

  /// One radiance for each vertex of the surface.
  void setRadiance(const std::vector<Rgb>& radiance);

 private:
  friend class LiveProgram;
  struct Buffers;
  std::unique_ptr<Buffers> buffers_;
};

/// Interpolates radiance over triangles and shows it as sRGB. Bound to a context like a LayerDrawing.
class LiveProgram {
 public:
  /// Throws an Error with the driver's words when the shaders do not compile.
  LiveProgram();
  ~LiveProgram();

  /// Draws a layer with MeshLab's current view. `transform` is the layer's own, column by column; radiance is
  /// multiplied by 2^exposure.
  void draw(LayerDrawing& drawing, const std::array<float, 16>& transform, double exposure);

 private:
  struct Shaders;
  std::unique_ptr<Shaders> shaders_;
};

}  // namespace shbake::meshlab
