// Coefficients in other people's conventions, and back. Each function takes any order, in place.
#pragma once

#include <span>

namespace shbake::sh {

/// Coefficients of the same function in the basis with the Condon-Shortley phase (-1)^m, or from it: its own inverse.
/// Left out between light and transfer, it acts like half a turn about z.
void flipCondonShortley(int order, std::span<double> coefficients);

/// To coefficients of the basis whose functions have mean square 1 over the sphere (geodesy's "4 pi normalised",
/// without Condon-Shortley phase): divides by sqrt(4 pi).
void toGeodesy(int order, std::span<double> coefficients);
/// From them: multiplies by sqrt(4 pi).
void fromGeodesy(int order, std::span<double> coefficients);

/// A function given in axes with z up, for axes with y up: the scene is turned by -90 degrees about x, so that what lay
/// along +z lies along +y and what lay along +y along -z. Right-handed axes stay right-handed.
/// Throws a usage error unless 1 <= order <= kMaxTurnOrder.
void toYUp(int order, std::span<double> coefficients);
/// The inverse.
void fromYUp(int order, std::span<double> coefficients);

}  // namespace shbake::sh
