// Size checks shared by the functions of this layer.
#pragma once

#include <cstddef>

namespace shbake::sh {

/// Throws a usage error unless `order` is 1 or more and `size`, the length of the array called `what`, holds at least
/// order^2 coefficients.
void requireCoefficients(int order, std::size_t size, const char* what);

/// Throws a usage error unless lowest <= order <= highest; `what` names the thing that has the order.
void requireOrder(int order, int lowest, int highest, const char* what);

}  // namespace shbake::sh
