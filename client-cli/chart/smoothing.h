#pragma once

#include <vector>

namespace cellcrush::client {

/// Mean of `y` over the points whose x lies within half of `window` on either side, at every point. x ascends; x and y
/// have equal length.
std::vector<double> running_mean(const std::vector<double>& x, const std::vector<double>& y, double window);

/// The value below which `share` of the values lie. REQUIRES: values is not empty, 0 <= share <= 1.
double quantile(std::vector<double> values, double share);

}  // namespace cellcrush::client
