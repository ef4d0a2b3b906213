// Our own: the classes that `shbake bake` runs, on chosen points.
#include "chart/methods/method.h"
#include "chart/methods/table_method.h"

namespace shbake::chart {

Estimate estimateShbake(const TestBed& bed, const Task& task, Progress& progress) {
  return estimateExactly(bed, task, progress, {DirectionSet(task.rays, task.order)});
}

}  // namespace shbake::chart
