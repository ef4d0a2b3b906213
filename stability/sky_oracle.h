// The sky that a vertex truly sees: the obviously right, slow twin of what shbake traces.
#pragma once

#include <cstdint>
#include <vector>

#include "shbake.h"

namespace shbake::stability {

/// Sky seen from just above a face beside a vertex, the limit of coming ever nearer to both. All faces are tried, in
/// extended precision and at the exact positions given; none is left out by its number, by an angle or a distance.
///
/// The ray starts at a distance of 1e-10 of the mesh's size from the vertex. Around the vertex the mesh looks the same
/// at every scale, and in the limit only the sectors count into which the faces there cut the directions. A direction
/// is blocked where the ray has changed the side of a surface an odd number of times when it leaves the surroundings,
/// 1e-8 of the size (a ridge that it crosses and leaves again shrinks to nothing), or meets any face after that.
class SkyOracle {
 public:
  /// Positions are used as they stand; faces whose positions agree exactly hang together. Degenerate faces, and further
  /// faces with the same three positions, do not count.
  SkyOracle(std::vector<Vec3d> positions, std::vector<Triangle> faces);

  /// A place where the rays of a vertex start, and the cones of directions in which the faces lie, seen from there.
  class Start;
  /// Beside vertex `v` in the middle of the widest of its faces, above it on the side of `normal`. Several where faces
  /// are equally wide to 0.1 %: at the end of an open sheet, what is seen depends on which of them a ray starts, and
  /// none is more right than the others. Of very many, kMostStarts. None for a vertex that is no corner of a face with
  /// an area.
  std::vector<Start> startsAt(std::uint32_t v, const Vec3d& normal) const;
  static constexpr std::size_t kMostStarts = 4;

  /// Whether light from a direction of unit length reaches the start.
  bool seesSky(const Start& start, const Vec3d& direction) const;

 private:
  Start startAbove(const Vec3d& vertex, const Vec3<long double>& offset) const;

  std::vector<Vec3d> positions_;
  std::vector<Triangle> faces_;               // those that count
  std::vector<std::vector<Triangle>> users_;  // of each vertex
  std::vector<std::uint32_t> part_;           // of each face: a number that connected faces share
  std::uint32_t parts_ = 0;
  double size_ = 0;
};

class SkyOracle::Start {
 private:
  friend class SkyOracle;
  /// Directions d with axis . d >= least hold all that lead to a face; `least` is below -1 where every direction may.
  struct Cone {
    Vec3d axis;
    double least;
  };
  Vec3<long double> origin_;
  std::vector<Cone> cones_;  // one a face
};

}  // namespace shbake::stability
