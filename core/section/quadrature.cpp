#include "section/quadrature.h"

#include <cmath>
#include <numbers>

namespace cellcrush {
namespace {

struct Legendre {
  double value;     // P_n(x)
  double previous;  // P_{n-1}(x)
};

Legendre legendre(int n, double x) {
  double previous = 1.0;
  double value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
    previous = value;
    value = next;
  }
  return {value, previous};
}

constexpr int kNewtonSteps = 50;

}  // namespace

Quadrature gauss_rule(int n) {
  Quadrature rule;
  for (int i = 0; i < n; ++i) {
    if (n == 1) {
      return {{0.0}, {2.0}};
    }
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Legendre p = legendre(n, x);
      slope = n * (x * p.value - p.previous) / (x * x - 1.0);
      x -= p.value / slope;
    }
    rule.points.push_back(x);
    rule.weights.push_back(2.0 / ((1.0 - x * x) * slope * slope));
  }
  return rule;
}

Quadrature lobatto_rule(int n) {
  // The inner points are the zeros of P'_{n-1}. Newton's method is applied to (1 - x^2) P'_{n-1} = (n - 1) (P_{n-2} - x
  // P_{n-1}), whose derivative is -n (n - 1) P_{n-1}.
  Quadrature rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * i / (n - 1));
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Legendre p = legendre(n - 1, x);
      x -= (x * p.value - p.previous) / (n * p.value);
    }
    const double value = legendre(n - 1, x).value;
    rule.points.push_back(x);
    rule.weights.push_back(2.0 / (n * (n - 1) * value * value));
  }
  return rule;
}

}  // namespace cellcrush
