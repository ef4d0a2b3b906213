// Baked transfer under a light: the colours that a viewer sees, and an audit of those that ringing makes negative.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/vec3.h"
#include "light/light.h"
#include "light/rig.h"
#include "mesh/mesh.h"
#include "sh/window.h"
#include "transfer/transfer_set.h"

namespace shbake {

struct RelightOptions {
  sh::Window window = sh::Window::none;  ///< damps the light against ringing, at the order that is used
  bool clampNegative = false;            ///< negative radiance becomes 0, channel by channel
};

/// The light as a transfer of `order` uses it: cut to the bands that both have, then windowed. `automatic` damps all
/// channels alike, by the least window that leaves none negative. Throws a usage error where no window can
/// (sh::automaticLambda()).
Light usedLight(const Light& light, int order, sh::Window window);

/// Outgoing radiance of each point in linear RGB: the sum of L_i t_i over the bands that light and transfer share
/// (maths.md (5)). One channel of transfer serves the three of the light. Summed in single precision in eight lanes of
/// fixed order, so that the result depends on neither threads nor machine; with m = n^2 terms its error is at most
/// (m / 8 + 6) 2^-24 sum |L_i t_i|. Throws a usage error for a transfer without points' coefficients in whole rows of 1
/// or 3 channels.
std::vector<Rgb> relight(const TransferSet& transfer, const Light& light, const RelightOptions& options,
                         const Parallel& parallel);

/// The same under local lights: `places` has the position of each point in the axes of the rig, and the radiance is
/// that under the rig's samples, blended by their weights there. A window damps all samples alike. Throws a usage
/// error, too, unless there is a place for each point, and for a window of samples whose orders differ.
std::vector<Rgb> relight(const TransferSet& transfer, std::span<const Vec3d> places, const LightRig& rig,
                         const RelightOptions& options, const Parallel& parallel);

/// Where relit colours are negative, which no light is: ringing of a light that was cut to few bands.
struct NegativeAudit {
  double areaShare = 0;         ///< 0..1: of the area that belongs to vertices with a negative channel (vertexAreas())
  double worst = 0;             ///< the least channel's radiance, 0 where none is negative
  std::size_t worstVertex = 0;  ///< that has it
  double worstShare = 0;        ///< -worst relative to the greatest radiance of any channel; 0 where none is positive
};

/// Throws a usage error unless there is a colour for each vertex.
NegativeAudit auditNegatives(const Mesh& mesh, std::span<const Rgb> colors);

}  // namespace shbake
