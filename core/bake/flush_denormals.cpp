// The floating-point mode that rays are traced in: two bits of the SSE control register, where there is one.
#include "bake/flush_denormals.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace shbake {

#ifdef __SSE__
FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
  _mm_setcsr(saved_ | 0x8040);
}
FlushDenormals::~FlushDenormals() {
  _mm_setcsr(saved_);
}
#else
FlushDenormals::FlushDenormals() : saved_(0) {}
FlushDenormals::~FlushDenormals() = default;
#endif

}  // namespace shbake
