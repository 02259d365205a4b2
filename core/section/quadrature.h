#pragma once

#include <vector>

namespace cellcrush {

/// Points in [-1, 1], ascending, and weights that sum to 2.
struct Quadrature {
  std::vector<double> points;
  std::vector<double> weights;
};

/// Gauss-Legendre rule, exact for polynomials of degree 2n - 1. REQUIRES: n >= 1.
Quadrature gauss_rule(int n);

/// Gauss-Lobatto rule, whose points include both ends; exact for polynomials of degree 2n - 3. REQUIRES: n >= 2.
Quadrature lobatto_rule(int n);

}  // namespace cellcrush
