#pragma once

#include <optional>
#include <vector>

namespace cellcrush::client {

/// Moving average: the mean of `y` over all points within half of `window` of each x. x ascends; x and y have equal
/// length.
std::vector<double> running_mean(const std::vector<double>& x, const std::vector<double>& y, double window);

/// The quantile of the values at `share`. REQUIRES: values is not empty, 0 <= share <= 1.
double quantile(std::vector<double> values, double share);

/// y = constant + linear x + quadratic x^2.
struct QuadraticFit {
  double constant = 0.0;
  double linear = 0.0;
  double quadratic = 0.0;
  double largest_residual = 0.0;  ///< greatest |y - fit| over the points
  int point_count = 0;

  /// Whether it passes through any points it was given, so that its residual is round-off only.
  [[nodiscard]] bool passes_through() const { return point_count == 3; }

  [[nodiscard]] double at(double x) const { return constant + x * (linear + x * quadratic); }
};

/// The fit of factor times y.
QuadraticFit scaled(const QuadraticFit& fit, double factor);

/// The least-squares fit through points; x and y have equal length. Nothing with fewer than three distinct finite x,
/// where the fit is not unique.
std::optional<QuadraticFit> find_quadratic_fit(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace cellcrush::client
