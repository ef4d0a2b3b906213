#include "bake/senders.h"

#include "bake/baker.h"

namespace shbake {

Senders::Senders(TracedPoints& traced, const TransferSet& baked, const BakeOptions& bake, const Parallel& parallel,
                 Progress& progress) {
  if (bake.kind != TransferKind::interreflected || bake.bounces == 0) return;
  if (bake.bounces == BakeOptions::kBouncesAuto) {
    transfer_ = &baked;
    return;
  }
  BakeOptions oneLess = bake;
  --oneLess.bounces;
  transfer_ = &fewerBounces_.emplace(bakePoints(traced, {}, oneLess, parallel, progress).transfer);
}

}  // namespace shbake
