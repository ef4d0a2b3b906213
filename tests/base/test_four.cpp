// Arithmetic of four doubles at once: lane by lane that of one.
#include <catch2/catch.hpp>
#include <vector>

#include "base/four.h"

using namespace shbake;

namespace {

Four of(double a, double b, double c, double d) {
  Four four;
  four.set(0, a);
  four.set(1, b);
  four.set(2, c);
  four.set(3, d);
  return four;
}

}  // namespace

TEST_CASE("each lane is calculated with by itself", "[four]") {
  const Four a = of(1, -2, 0.1, 1e300), b = of(3, 0.5, 0.2, 1e10);
  const Four sum = a + b, difference = a - b, product = a * b, scaled = 3.0 * a;
  for (int i = 0; i < 4; ++i) {
    CHECK(sum[i] == a[i] + b[i]);
    CHECK(difference[i] == a[i] - b[i]);
    CHECK(product[i] == a[i] * b[i]);
    CHECK(scaled[i] == 3 * a[i]);
    CHECK(Four(7)[i] == 7);
  }
}

TEST_CASE("arrays of four are aligned for any vector unit", "[four]") {
  for (std::size_t n = 1; n < 20; ++n) {
    const std::vector<Four> some(n);
    CHECK(reinterpret_cast<std::uintptr_t>(some.data()) % 32 == 0);
    CHECK(some[n - 1][3] == 0);
  }
}
