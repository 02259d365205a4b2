#include "chart/smoothing.h"

#include <algorithm>

namespace cellcrush::client {

std::vector<double> running_mean(const std::vector<double>& x, const std::vector<double>& y, double window) {
  std::vector<double> sums(y.size() + 1, 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) sums[i + 1] = sums[i] + y[i];
  std::vector<double> means(y.size());
  std::size_t begin = 0;
  std::size_t end = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    while (x[begin] < x[i] - 0.5 * window) ++begin;
    while (end < x.size() && x[end] <= x[i] + 0.5 * window) ++end;
    means[i] = (sums[end] - sums[begin]) / static_cast<double>(end - begin);
  }
  return means;
}

double quantile(std::vector<double> values, double share) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace cellcrush::client
