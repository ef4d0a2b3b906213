// What the faces of baked points reflect to places that had no part in the bake.
#pragma once

#include <optional>

#include "bake/bake_options.h"
#include "bake/traced_points.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "transfer/transfer_set.h"

namespace shbake {

/// The transfer that faces send to places between their corners, so that a place has as many reflections as a vertex.
class Senders {
 public:
  /// `baked` is what bakePoints() gave for `traced` with the options `bake`, whose `rays` must be the number that it
  /// took. It sends itself where reflections were summed to the tolerance; where they were counted, the last one is
  /// that towards the places, and the constructor bakes again with one less: it throws as bakePoints() then. `baked`
  /// must outlive the object.
  Senders(TracedPoints& traced, const TransferSet& baked, const BakeOptions& bake, const Parallel& parallel,
          Progress& progress);
  Senders(const Senders&) = delete;
  Senders& operator=(const Senders&) = delete;

  /// Null: nothing is reflected.
  const TransferSet* transfer() const { return transfer_; }

 private:
  std::optional<TransferSet> fewerBounces_;
  const TransferSet* transfer_ = nullptr;
};

}  // namespace shbake
