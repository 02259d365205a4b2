#include "chart/smoothing.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace cellcrush::client {

namespace {

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

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

QuadraticFit scaled(const QuadraticFit& fit, double factor) {
  return {factor * fit.constant, factor * fit.linear, factor * fit.quadratic, std::abs(factor) * fit.largest_residual,
          fit.point_count};
}

std::optional<QuadraticFit> find_quadratic_fit(const std::vector<double>& x, const std::vector<double>& y) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(x.begin(), x.end(), finite) || !std::all_of(y.begin(), y.end(), finite)) return std::nullopt;
  if (std::set<double>(x.begin(), x.end()).size() < 3) return std::nullopt;
  // Polynomials that are orthogonal over the points: 1, p = x - centre, q = p^2 - slope p - offset. Each coefficient is
  // then a projection of its own, without the badly conditioned normal equations.
  const double centre = mean(x);
  std::vector<double> p;
  std::vector<double> squares;
  for (const double value : x) {
    p.push_back(value - centre);
    squares.push_back(p.back() * p.back());
  }
  const double slope = product(squares, p) / product(p, p);
  const double offset = mean(squares);
  std::vector<double> q;
  for (std::size_t i = 0; i < x.size(); ++i) q.push_back(squares[i] - slope * p[i] - offset);
  const double along_p = product(y, p) / product(p, p);
  const double along_q = product(y, q) / product(q, q);
  QuadraticFit fit;
  fit.point_count = static_cast<int>(x.size());
  fit.quadratic = along_q;
  fit.linear = along_p - along_q * (slope + 2.0 * centre);
  fit.constant = mean(y) - along_p * centre + along_q * (centre * centre + slope * centre - offset);
  for (std::size_t i = 0; i < x.size(); ++i) {
    fit.largest_residual = std::max(fit.largest_residual, std::abs(y[i] - fit.at(x[i])));
  }
  return fit;
}

}  // namespace cellcrush::client
