// Windows against ringing.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "sh/extremes.h"
#include "sh/green_light.h"
#include "sh/support.h"
#include "sh/window.h"

using namespace shbake;
using namespace shbake::sh;
using namespace shbake::sh::testing;

TEST_CASE("windows of Green's light at order 4: least value and error") {
  struct Expected {
    Window window;
    double min, error;
  };
  // The known figures have three digits; half a unit of the last is 5e-4.
  for (const Expected& e : {Expected{Window::none, -0.1844, 0.512}, Expected{Window::hann, -0.021, 0.677},
                            Expected{Window::lanczos, -0.031, 0.623}, Expected{Window::gauss, -0.014, 0.664},
                            Expected{Window::automatic, 0, 0.773}}) {
    auto c = greenCoefficients(4);
    const double lambda = applyWindow(e.window, 4, c);
    REQUIRE(std::abs(valueRange(4, c).min.value - e.min) < 5e-4);
    REQUIRE(std::abs(greenError(c) - e.error) < 5e-4);
    if (e.window == Window::automatic) {
      REQUIRE(std::abs(lambda - 0.1717) < 5e-5);
    } else {
      REQUIRE(lambda == 0);
    }
  }
}

TEST_CASE("the automatic window is the least: a little less leaves a negative value") {
  for (int order = 3; order <= 9; ++order) {
    const auto c = greenCoefficients(order);
    const double lambda = automaticLambda(order, c);
    REQUIRE(lambda > 0);
    for (const double factor : {1.0, 0.999}) {
      auto smooth = c;
      applyFactors(laplacianFactors(lambda * factor, order), smooth);
      const double least = valueRange(order, smooth).min.value;
      if (factor == 1) {
        REQUIRE(least > -1e-11);
      } else {
        REQUIRE(least < -1e-6);
      }
    }
  }
}

TEST_CASE("light that is nowhere negative is left alone") {
  std::vector<double> c(9);
  c[0] = std::sqrt(4 * kPi);
  c[2] = 0.5;
  const auto before = c;
  REQUIRE(applyWindow(Window::automatic, 3, c) == 0);
  REQUIRE(c == before);
  std::vector<double> zero(9);
  REQUIRE(automaticLambda(3, zero) == 0);
}

TEST_CASE("a directional light of order 2 has its window in closed form") {
  // c_0 y_00 - |c_1| k / (1 + 4 lambda) = 0.
  std::vector<double> c{1, 0.3, -2, 0.4};
  const double slope = std::sqrt(3.0) * std::hypot(c[1], c[2], c[3]);
  REQUIRE(automaticLambda(2, c) == Approx((slope - 1) / 4).epsilon(1e-8));
}

TEST_CASE("no window helps a mean that is not positive") {
  REQUIRE_THROWS_AS(automaticLambda(2, std::vector<double>{0, 1, 0, 0}), Error);
  REQUIRE_THROWS_AS(automaticLambda(2, std::vector<double>{-1, 0, 0, 0}), Error);
}

TEST_CASE("windows keep the mean and never amplify") {
  for (const Window w : {Window::none, Window::hann, Window::lanczos, Window::gauss}) {
    for (const int order : {1, 2, 3, 9, 33}) {
      const auto f = windowFactors(w, order);
      REQUIRE(f[0] == 1);
      for (int l = 1; l < order; ++l) {
        REQUIRE(f[l] >= 0);
        REQUIRE(f[l] <= f[l - 1]);
      }
    }
  }
}

TEST_CASE("windows have names") {
  for (const Window w : {Window::none, Window::hann, Window::lanczos, Window::gauss, Window::automatic}) {
    REQUIRE(windowFromName(windowName(w)) == w);
  }
  REQUIRE_THROWS_WITH(windowFromName("Hann"), Catch::Contains("none, hann, lanczos, gauss, auto"));
  REQUIRE_THROWS_AS(windowFactors(Window::automatic, 3), Error);
  REQUIRE_THROWS_AS(laplacianFactors(-1, 3), Error);
  std::vector<double> eight(8);
  REQUIRE_THROWS_AS(applyWindow(Window::hann, 3, eight), Error);
  REQUIRE_THROWS_AS(applyWindow(Window::automatic, 3, eight), Error);
}
