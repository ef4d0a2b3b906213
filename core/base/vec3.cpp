#include "base/vec3.h"

namespace shbake {

Vec3d roundedToFloat(const Vec3d& v) {
  const volatile float x = static_cast<float>(v.x), y = static_cast<float>(v.y), z = static_cast<float>(v.z);
  return {x, y, z};
}

}  // namespace shbake
