// The projector of each layout.
#include "light/map_projector.h"

#include "light/chart_projector.h"
#include "light/lat_long_projector.h"

namespace shbake {

std::unique_ptr<MapProjector> makeMapProjector(const MapShape& shape, int order) {
  if (shape.layout == MapLayout::latLong) return std::make_unique<LatLongProjector>(shape, order);
  return std::make_unique<ChartProjector>(shape, order);
}

}  // namespace shbake
