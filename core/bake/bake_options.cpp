#include "bake/bake_options.h"

#include <cmath>
#include <string>

#include "base/error.h"

namespace shbake {

void validate(const BakeOptions& o) {
  const auto require = [](bool ok, const char* name, const std::string& value, const char* range) {
    if (!ok) throw usageError(std::string(name) + " " + value + " is out of range", std::string("use ") + range);
  };
  require(o.order >= 1 && o.order <= 32, "order", std::to_string(o.order), "1 to 32");
  require(o.rays >= 0 && o.rays <= 1 << 20, "rays", std::to_string(o.rays),
          "1 to 1048576, or 0 to choose by the tolerance");
  require(o.tolerance >= 1e-4 && o.tolerance <= 1, "tolerance", std::to_string(o.tolerance), "0.0001 to 1");
  require(o.bounces >= BakeOptions::kBouncesAuto && o.bounces <= 10000, "bounces", std::to_string(o.bounces),
          "0 to 10000, or auto");
  require(o.maxDistance > 0, "maximum distance", std::to_string(o.maxDistance), "a positive length");
}

}  // namespace shbake
