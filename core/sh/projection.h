// Functions on the sphere to coefficients and back.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace shbake::sh {

using SphereFunction = std::function<double(const Vec3d& direction)>;
using SphereRgbFunction = std::function<Vec3d(const Vec3d& direction)>;

/// The coefficients c_i = integral of f y_i (maths.md (4)) by a product rule. `functionDegree` is the degree up to
/// which f is followed: exact for a polynomial of that degree, an approximation for other functions (errors fall as the
/// degree rises; at a kink like 1 / degree^2). Throws a usage error when order is not in 1..kMaxBasisOrder or the
/// degree is negative.
std::vector<double> project(int order, const SphereFunction& f, int functionDegree);
/// The same for the three channels of a colour; the coefficients of channel c are in element c.
std::vector<Vec3d> projectRgb(int order, const SphereRgbFunction& f, int functionDegree);

/// Adds weight * y_i(direction) to out[i]: the projection of weighted samples one at a time. For a mean over N uniform
/// samples of f, the weight is f * 4 pi / N; for a texel, f times its solid angle. `order` is limited as in evaluate();
/// `scratch` holds order^2 values and is overwritten.
void accumulateSample(int order, const Vec3d& direction, double weight, std::span<double> scratch,
                      std::span<double> out);

/// The projection of samples: coefficients sum_k weights[k] y_i(directions[k]). Throws a usage error when the two
/// arrays differ in length.
std::vector<double> projectSamples(int order, std::span<const Vec3d> directions, std::span<const double> weights);

/// The value of the function with these order^2 coefficients in a direction of unit length.
double reconstruct(int order, std::span<const double> coefficients, const Vec3d& direction);

/// The integral of the product of two functions over the sphere: the dot product of their coefficients (maths.md (5)).
/// Of two lengths the shorter counts, since coefficients that are not there are zero.
double productIntegral(std::span<const double> a, std::span<const double> b);

/// The sum of squares of each of the `order` bands; together the integral of the function squared.
std::vector<double> bandEnergy(int order, std::span<const double> coefficients);

}  // namespace shbake::sh
