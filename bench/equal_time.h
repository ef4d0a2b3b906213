// Rays that point sampling traces in the CPU time of something else.
#pragma once

#include <functional>

namespace shbake::bench {

/// Compares the CPU time of what is run with that of point sampling. Both take turns for two seconds at least, and
/// medians count: on a busy machine one bake tells less of its cost than of what runs beside it.
class EqualTime {
 public:
  /// `points(n)` samples points with n rays each. The time of `rays` is what others are compared with; that of other
  /// numbers follows from it and from that of three times as many: a part of it goes with the rays.
  EqualTime(std::function<void(int)> points, int rays);

  /// What a run takes.
  struct Cost {
    double seconds = 0;  ///< CPU time
    double rays = 0;     ///< a point, of point sampling in the same time; 1 at least
  };
  Cost of(const std::function<void()>& run) const;

 private:
  /// The median CPU seconds of `run` and of point sampling.
  struct Seconds {
    double run, points;
  };
  Seconds inTurns(const std::function<void()>& run) const;

  std::function<void(int)> points_;
  int rays_;
  double shareOfRays_;  // of the time of point sampling with rays_
};

/// An error at a number of `rays` that need not be whole, of bakes that take whole groups of them: between two of these
/// it is a power of the rays. `errorOf(n)` has the error of n rays.
double errorBetweenGroups(double rays, const std::function<double(int)>& errorOf);

}  // namespace shbake::bench
