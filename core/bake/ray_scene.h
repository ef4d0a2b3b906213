// Rays that start at a lighting point's position, traced among the faces of a scene.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bake/contact_search.h"
#include "bake/face_tree.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "mesh/lighting_points.h"

namespace shbake {

/// Where a ray ended, in 8 bytes.
struct Hit {
  std::uint32_t face;
  std::uint16_t u, v;  ///< barycentric weights of corners 1 and 2 in units of 1/65535; corner 0 has the rest
};

/// Faces touching the ray's own position never count as hit: they are told by welded position ids (own_faces.h), not by
/// an offset (Green 2003's exclusion rule). Nor do faces that the position lies on without sharing it
/// (T-junctions, a box standing on the ground), up to contactDistance() from the position to the face's plane. Measured
/// along the ray, it would be exceeded by grazing rays on one side and would lose near faces that are met head-on on
/// the other. What both kinds block is for fan_test.h to tell.
class RayScene {
 public:
  /// Groups of rays in a call, at most.
  static constexpr int kMaxGroups = 64;

  /// Rays are as long as `maxDistance` in work units. `tree` holds the faces of `points`, which may have places beyond
  /// those that it was built of (addPlaces()); `contacts` knows all positions that rays will start from. References
  /// must outlive the scene.
  RayScene(const LightingPoints& points, const FaceTree& tree, const Contacts& contacts, float maxDistance);

  /// With a tree and contacts of its own, for rays from all positions. Throws as FaceTree's constructor.
  RayScene(const LightingPoints& points, float maxDistance, const Parallel& parallel, Progress& progress);
  ~RayScene();

  /// What positions lie on without sharing it.
  const Contacts& contacts() const;

  /// Rays from one position, in groups of 16: directions in a local frame and its axes in the world.
  struct Rays {
    std::uint32_t position;       // position id: origin and what to leave out
    int groups;                   // 1..kMaxGroups
    const float *x, *y, *z;       // groups * 16 components each, local unit directions
    Vec3f axisX, axisY, axisZ;    // orthonormal
    const std::uint16_t* active;  // a mask for each group: only these rays are traced

    /// The world directions of a group.
    void turn(int group, float* worldX, float* worldY, float* worldZ) const;
  };

  /// Space for one thread's rays. Make one for each worker.
  class Buffers;
  struct BuffersDeleter {
    void operator()(Buffers* buffers) const;
  };
  using BuffersPtr = std::unique_ptr<Buffers, BuffersDeleter>;
  BuffersPtr makeBuffers() const;

  /// Sets in hit[g] the bits of the active rays that are blocked.
  void occluded(const Rays& rays, Buffers& buffers, std::uint16_t* hit) const;

  /// The same for several positions, at most kMaxGroups groups together, which are numbered through: rays of neighbours
  /// are traced faster together than one position's alone, where these are few.
  void occluded(std::span<const Rays> batch, Buffers& buffers, std::uint16_t* hit) const;

  /// Finds the nearest hits: sets bits in hit[g], the bits of those that met a face's front in front[g], and hits[g *
  /// 16 + i]. Of two coincident faces wound against each other, the one whose front is met is hit (face_twins.h).
  void closest(const Rays& rays, Buffers& buffers, std::uint16_t* hit, std::uint16_t* front, Hit* hits) const;

 private:
  struct State;
  /// A mask for each group of a call.
  using Masks = std::array<std::uint16_t, kMaxGroups>;

  unsigned findDoubtful(std::span<const Rays> batch, const Masks& open, const std::uint16_t* hit, Buffers& buffers,
                        Masks& doubtful) const;
  void traceShadows(std::span<const Rays> batch, const Masks& active, bool filtered, Buffers& buffers,
                    std::uint16_t* hit) const;
  void tracePackets(std::span<const Rays> batch, const Masks& active, bool filtered, Buffers& buffers,
                    std::uint16_t* hit) const;
  template <class Take>
  void traceHits(const Rays& rays, const std::uint16_t* active, bool filtered, Buffers& buffers,
                 const Take& take) const;

  struct Own;
  std::unique_ptr<Own> own_;
  std::unique_ptr<const State> state_;
};

}  // namespace shbake
