#include "results/quadratic_fit.h"

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
