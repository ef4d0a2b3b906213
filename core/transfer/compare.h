// The error of one bake measured against another (design: conventions "Quality figures").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/vec3.h"
#include "transfer/baked_ply.h"

namespace shbake {

/// How far transfer A is from the reference B. Errors are relative transfer errors: ||t_A - t_B|| / ||t_unshadowed||
/// over all channels, with the same albedo; 0.01 is one per cent.
struct TransferComparison {
  int order = 0;     ///< bands that both have, which is what was compared
  int channels = 0;  ///< 3 when either has three: the single channel of the other then counts for each of them

  std::size_t matched = 0;     ///< vertices of A that were compared
  std::size_t unmatchedA = 0;  ///< vertices of A without a partner in B
  std::size_t unmatchedB = 0;  ///< vertices of B without a partner in A
  std::size_t black = 0;       ///< vertices of A with a partner, but with albedo 0: they have no relative error
  double matchDistance = 0;    ///< positions matched within this, in file units (see PointMatcher)

  double rmsError = 0;  ///< weighted by the area of A's faces around each vertex
  double worstError = 0;
  std::uint32_t worstVertex = 0;  ///< of A
  Vec3d worstPosition;

  /// The area-weighted RMS of sh_error; without it, rms_error of the header; without both, nothing.
  std::optional<double> statedRmsA, statedRmsB;
  /// Share of the matched vertices whose error exceeds three times what is stated (sh_error of A, with that of B in
  /// quadrature where it has one) by more than the rounding of floats. Nothing when A states none.
  std::optional<double> shareBeyondStated;

  std::vector<float> errors;       ///< of each vertex of A; NaN where it was not compared
  std::vector<std::string> notes;  ///< on what terms the two were compared, one sentence each
};

/// Compares A with the reference B. Vertices that no face uses carry no light and are left out of all counts (unless
/// the file has no faces at all; vertices then weigh the same). The albedo that errors are relative to is B's, else
/// A's, as bakedAlbedo() tells it; when neither is known, it is taken as uniform, each channel's the largest t_0 / y_00
/// of B: what a white sky of radiance 1 makes the brightest point send out, which is the albedo where that point sees
/// the whole sky, and less otherwise.
/// Throws an Error that names the file: normals are missing, no vertex of A has a partner, only one of the two has its
/// albedo multiplied in, or the albedo is black throughout. Progress counts vertices.
TransferComparison compareTransfer(const BakedPly& a, const BakedPly& b, Progress& progress);

}  // namespace shbake
