#pragma once

#include <vector>

namespace cellcrush::client {

/// Moving average: the mean of `y` over all points within half of `window` of each x. x ascends; x and y have equal
/// length.
std::vector<double> running_mean(const std::vector<double>& x, const std::vector<double>& y, double window);

/// The quantile of the values at `share`. REQUIRES: values is not empty, 0 <= share <= 1.
double quantile(std::vector<double> values, double share);

}  // namespace cellcrush::client
