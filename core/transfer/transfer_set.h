// Baked light transfer: coefficients, stated errors and the facts needed to use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"

namespace shbake {

/// How much of the light's way the transfer accounts for.
enum class TransferKind { unshadowed, shadowed, interreflected };

/// The name used on the command line and in files: "unshadowed", "shadowed", "interreflected".
const char* transferName(TransferKind kind);
/// The kind of that name, spelt exactly so; nothing for any other word.
std::optional<TransferKind> transferKindOf(std::string_view name);

/// SH transfer vectors of a list of points (design: conventions "Basis" and "Units").
/// Outgoing radiance of point p in channel c under light L is the sum over i of L_i * at(p, c)[i].
struct TransferSet {
  int order = 0;     ///< bands: order^2 coefficients a channel, degrees 0..order-1
  int channels = 1;  ///< 1 where all albedo is grey, else 3 (red, green, blue)

  std::vector<float> coefficients;  ///< points x channels x order^2, index l(l+1)+m fastest
  std::vector<float> error;  ///< stated standard error of each point, relative to its unshadowed transfer; or empty
  std::vector<float> visibility;  ///< cosine-weighted share of the sky that each point sees, 0..1; or empty

  int coefficientsPerChannel() const { return order * order; }
  std::size_t stride() const { return static_cast<std::size_t>(channels * order * order); }
  std::size_t size() const { return stride() == 0 ? 0 : coefficients.size() / stride(); }
  std::span<const float> at(std::size_t point, int channel) const {
    return {coefficients.data() + point * stride() + static_cast<std::size_t>(channel) * order * order,
            static_cast<std::size_t>(order * order)};
  }
};

/// Where the albedo behind a transfer came from.
enum class AlbedoOrigin { unknown, uniform, vertexColors, faceColors };

/// The albedo behind a transfer: what is needed to tell it again from the mesh.
struct AlbedoFacts {
  bool included = true;  ///< the direct term has been multiplied by it
  AlbedoOrigin origin = AlbedoOrigin::unknown;
  Rgb uniform;                  ///< linear, for AlbedoOrigin::uniform
  bool bytesAreLinear = false;  ///< 8-bit colours were taken as linear instead of sRGB
};

/// How far the transfer interpolated between the vertices, which is what a viewer sees, is from the true one: relative
/// transfer errors at random points of the surface (bake/surface_error.h).
struct SurfaceError {
  std::size_t samples = 0;  ///< points of the surface; 0: not measured
  int rays = 0;             ///< rays traced from each; 0 where the transfer has a closed form
  double rms = 0;           ///< area-weighted, freed from the noise of the rays
  double low = 0;           ///< 95 % confidence interval of `rms`
  double high = 0;
  double worst = 0;     ///< the largest error of a sample
  Vec3d worstPosition;  ///< its place, in file units

  friend bool operator==(const SurfaceError&, const SurfaceError&) = default;
};

/// The source of a vertex that is none of the input's: a refinement made it. -1 in files.
inline constexpr std::uint32_t kNewVertex = 0xFFFFFFFFu;

/// What was changed of the transfer traced at the vertices, so that it interpolates better (bake/surface_fit.h). The
/// stated errors and the visibility stay those of the vertices as traced.
struct FitFacts {
  std::size_t fittedPoints = 0;    ///< lighting points whose transfer was fitted to the surface
  std::size_t smoothedPoints = 0;  ///< lighting points whose transfer was smoothed over their neighbours
  double before = 0;  ///< surface error (SurfaceError::rms) without the change, at samples of the fit's own
  double after = 0;   ///< and with it

  bool any() const { return fittedPoints + smoothedPoints > 0; }
  friend bool operator==(const FitFacts&, const FitFacts&) = default;
};

/// How a transfer set came about: written to and read from file headers.
struct TransferFacts {
  std::string version;  ///< of the shbake that baked
  TransferKind kind = TransferKind::interreflected;
  int bounces = 0;                ///< reflections summed; the number of solver steps where `bouncesConverged`
  bool bouncesConverged = false;  ///< reflections were summed to the tolerance, not to a count
  int rays = 0;                   ///< directions a point; 0 for the closed form
  std::uint64_t seed = 0;
  std::string sampler;   ///< "closed-form" or "cosine-fibonacci"
  double rmsError = 0;   ///< area-weighted RMS of the stated errors
  double maxError = 0;   ///< the largest stated error
  double tolerance = 0;  ///< what was asked for; 0 when rays were given instead
  AlbedoFacts albedo;
  std::size_t lightingPoints = 0;
  std::size_t sourceVertices = 0;
  std::string source;                                            ///< the mesh file's name without its folder
  bool twoSided = false;                                         ///< faces reflected from both sides
  double maxDistance = std::numeric_limits<double>::infinity();  ///< beyond it nothing was seen, in file units
  std::size_t blockers = 0;                                      ///< meshes that blocked and reflected beside this one
  FitFacts fit{};
  SurfaceError surface{};
};

}  // namespace shbake
