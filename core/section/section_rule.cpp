#include "section/section_rule.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

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

/// Both joints and two inner points, exact to degree 3 for any end weight.
Quadrature short_ended_rule() {
  constexpr double kEndWeight = 0.1;  // on [-1, 1]
  const double inner_weight = 1.0 - kEndWeight;
  const double inner = std::sqrt((1.0 / 3.0 - kEndWeight) / inner_weight);
  return {{-1.0, -inner, inner, 1.0}, {kEndWeight, inner_weight, inner_weight, kEndWeight}};
}

Quadrature along_rule(const SectionSpec& spec) {
  if (spec.formulation == SectionSpec::Formulation::displacement_based) {
    return gauss_rule(spec.axial_count());
  }
  return spec.axial_count() == 4 ? short_ended_rule() : lobatto_rule(spec.axial_count());
}

void add_pair(double place, double weight, Quadrature& rule) {
  rule.points.insert(rule.points.begin(), -place);
  rule.points.push_back(place);
  rule.weights.insert(rule.weights.begin(), weight);
  rule.weights.push_back(weight);
}

/// Pairs of points at y and -y on [-1, 1], from the middle outwards. The weights of the last three follow from three
/// sums over one side: 1, of |y| 1/2 and of y^2 1/3, like the section itself (area, full plastic moment and bending
/// stiffness). The weights of the others are given.
Quadrature rule_of_pairs(std::span<const double> places, std::span<const double> weights) {
  Quadrature rule;
  Eigen::Vector3d sums(1.0, 0.5, 1.0 / 3.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    add_pair(places[i], weights[i], rule);
    sums -= weights[i] * Eigen::Vector3d(1.0, places[i], places[i] * places[i]);
  }
  const Eigen::Map<const Eigen::RowVector3d> last(places.last(3).data());
  Eigen::Matrix3d moments;
  moments << Eigen::RowVector3d::Ones(), last, last.cwiseAbs2();
  const Eigen::Vector3d last_weights = moments.inverse() * sums;
  for (Eigen::Index i = 0; i < 3; ++i) {
    add_pair(last[i], last_weights[i], rule);
  }
  return rule;
}

Quadrature full_moment_rule(int points) {
  if (points == 4) {
    Quadrature rule;
    constexpr double kOuter = 0.805;
    const double inner = (0.5 * kOuter - 1.0 / 3.0) / (kOuter - 0.5);
    const double outer_weight = (0.5 - inner) / (kOuter - inner);
    add_pair(inner, 1.0 - outer_weight, rule);
    add_pair(kOuter, outer_weight, rule);
    return rule;
  }
  if (points == 10) {
    return rule_of_pairs(std::array{0.0868, 0.2984, 0.5198, 0.7328, 0.9333}, std::array{0.1893, 0.2231});
  }
  return rule_of_pairs(std::array{0.15, 0.52, 0.88}, {});
}

Quadrature depth_rule(const SectionSpec& spec) {
  return spec.depth_rule == SectionSpec::DepthRule::lobatto ? lobatto_rule(spec.depth_count())
                                                            : full_moment_rule(spec.depth_count());
}

Eigen::ArrayXd to_array(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

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

SectionRule make_section_rule(const SectionSpec& spec) {
  const Quadrature along = along_rule(spec);
  const Quadrature through = depth_rule(spec);
  SectionRule rule;
  rule.force_based = spec.formulation == SectionSpec::Formulation::force_based;
  rule.along = 0.5 * (1.0 + to_array(along.points));
  rule.along_weight = 0.5 * to_array(along.weights);
  rule.offset = 0.5 * to_array(through.points);
  rule.depth_weight = 0.5 * to_array(through.weights);
  rule.shear_factor = spec.shear_deformation ? spec.shear_factor : 0.0;
  rule.coupled_bending = spec.coupled_bending;
  return rule;
}

}  // namespace cellcrush
