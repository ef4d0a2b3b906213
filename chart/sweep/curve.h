// Measured points of speed against accuracy, and what is read off them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace shbake::chart {

/// One setting of one method.
struct CurvePoint {
  int rays = 0;            ///< the method's own measure of effort
  double traced = 0;       ///< rays traced a point, on average
  double cpu = 0;          ///< CPU seconds for the whole mesh: the least of the runs
  double cpuSpread = 0;    ///< standard error of `cpu`, relative to it (leastTime())
  double error = 0;        ///< RMS of the runs; 0 where nothing is left of it beyond the reference's noise
  double errorSpread = 0;  ///< standard error of `error` over the runs, relative to it
  int runs = 0;
};

/// Whether a point is on the Pareto front of `points`: none takes less time and errs less at once, or is no worse in
/// one and better in the other.
std::vector<bool> paretoFront(std::span<const CurvePoint> points);

/// The time of something from times of its runs, to which all else that the machine does can only add.
struct LeastTime {
  double cpu = 0;     ///< the least of them
  double spread = 0;  ///< its standard error, relative to it; 0 for a single run
};

/// With delays that are exponentially distributed with mean d, the least of n runs is late by d / n, give or take as
/// much, and the mean of the runs is later than the least by d (n - 1) / n: the standard error of the least is
/// (mean - least) / (n - 1). `times` has one or more.
LeastTime leastTime(std::span<const double> times);

/// How far a point is from the front of others.
struct Excess {
  /// The largest factor f such that one of them is f times as fast and f times as accurate, or better; below 1 nothing
  /// is both faster and more accurate, at 1 something is equal in one.
  double factor = 0;
  /// Whether one of them leads in both by more than chance: by more than three standard errors of the ratio of times,
  /// and of the ratio of errors. A factor above 1 that is not is a tie.
  bool beyondChance = false;
};

Excess excessOverFront(const CurvePoint& point, std::span<const CurvePoint> others);

/// The exponent s of error ~ rays^s by least squares in logarithms over points with least <= rays <= most and an error
/// above 0; nothing for fewer than three of them.
std::optional<double> slopeOf(std::span<const CurvePoint> points, int least, int most);

/// A setting read off a curve.
struct Reading {
  double rays = 0, cpu = 0;
};

/// The least effort that reaches `error`, by power laws between points in the order of their rays; nothing where no
/// point does. Where the first point does already, that point.
std::optional<Reading> effortFor(std::span<const CurvePoint> points, double error);

/// What a curve tells of the effort for an error.
struct Reach {
  enum class Kind {
    reached,  ///< at `reading`
    beyond,   ///< not at `reading`, the last point: more than that
    never,    ///< the error that rays do not mend is greater
  };
  Kind kind = Kind::never;
  Reading reading;
};

/// effortFor() that tells why not. `systematic` is the error that rays do not mend, where it is known; a curve without
/// points reaches nothing.
Reach reachOf(std::span<const CurvePoint> points, std::optional<double> systematic, double error);

}  // namespace shbake::chart
