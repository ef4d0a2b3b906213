// Pictures of a mesh whose vertices have colours.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "base/vec3.h"
#include "mesh/mesh.h"
#include "view/camera.h"
#include "view/picture.h"
#include "view/tone_map.h"

namespace shbake {

/// What is seen past the mesh.
struct Background {
  /// Radiance from a direction of unit length; empty: the gradient below.
  std::function<Rgb(const Vec3d& direction)> radiance;
  /// At the upper and lower edge of the picture, as the display shows them: neither exposed nor mapped.
  Rgb top{0.30f, 0.33f, 0.37f}, bottom{0.10f, 0.11f, 0.12f};
};

struct RenderOptions {
  int width = 800, height = 600;
  int samples = 3;             ///< along each side of a pixel, 1..16
  bool cullBackFaces = false;  ///< leaves out the faces turned away, so that one looks into a closed room
  /// What samples are mapped with before they are averaged, so that edges against bright things are smooth too; empty:
  /// the picture holds radiance.
  std::optional<ToneMap> tone;
  Background background;
};

/// Draws the triangles with `colors`, the radiance of each vertex, interpolated linearly over each triangle in space
/// (perspective-correct), the nearest surface winning, of equally near ones the first triangle. Edges are found in
/// exact integer arithmetic on a grid of 1/256 sample, so that triangles which share vertices leave no gap. Negative
/// radiance is drawn black, or kept where `tone` is empty. What reaches behind the camera is cut off
/// (placeTriangles()). Threads share bands of rows: the result does not depend on them. Throws a usage error for
/// options out of range and unless there is a colour for each vertex.
Picture render(const Mesh& mesh, std::span<const Rgb> colors, const Camera& camera, const RenderOptions& options,
               const Parallel& parallel);

}  // namespace shbake
