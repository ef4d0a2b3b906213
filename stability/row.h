// A row of the stability table: a place where methods fail, and how often they do.
#pragma once

#include <cstddef>
#include <span>

#include "shbake.h"

namespace shbake::stability {

/// Cases tried and those that went wrong.
struct Count {
  std::size_t cases = 0, failures = 0;

  void add(bool fails) {
    ++cases;
    failures += fails ? 1 : 0;
  }
  Count& operator+=(const Count& other) {
    cases += other.cases;
    failures += other.failures;
    return *this;
  }
  /// The share that went wrong, 0..1; 0 where nothing was tried.
  double rate() const { return cases == 0 ? 0 : static_cast<double>(failures) / static_cast<double>(cases); }
};

/// What a row has found.
struct Outcome {
  Count naive;  ///< of the usual way
  Count own;    ///< of shbake

  Outcome& operator+=(const Outcome& other) {
    naive += other.naive;
    own += other.own;
    return *this;
  }
};

/// What a row works with. Results depend on `brief` alone, never on threads.
struct Bench {
  const Parallel& parallel;
  Progress& progress;  ///< only cancels: stages of bakes within a row are not shown
  bool brief = false;  ///< fewer meshes, turns and vertices: seconds for the whole table
};

/// One row. All texts are half sentences without a full stop, which stand in the table as they are.
struct Row {
  const char* id;      ///< its name in reports, in lower case with dashes: "closed-rooms"
  const char* family;  ///< the name of its family
  const char* place;   ///< where methods fail: "corners of closed rooms"
  const char* seen;    ///< what a user sees when one does
  const char* naive;   ///< the usual way, which is tried beside shbake's
  const char* done;    ///< what shbake does instead
  const char* option;  ///< the option or function that governs it
  const char* wrong;   ///< what a case is and when it counts as failed
  double bound;        ///< the share of shbake's own cases that may fail, 0..1
  Outcome (*measure)(const Bench& bench);
};

/// The least difference of light between neighbouring patches that eyes notice, relative to the light of an open point
/// (Weber's fraction, about 1/50): what a case about light may be off by.
inline constexpr double kNoticeable = 0.02;

}  // namespace shbake::stability
