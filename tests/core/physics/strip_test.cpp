// Strips, deeper than thick and less deep than long, bend elastically in plane stress and flow in plane strain (E6b):
// the reasons, from the theory of plates, and what the walls make of it. A measured ring is in tests/validation. Blind
// to: strips between both, and the way from one to the other while a hinge begins to flow.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/mesh_part.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::strips {
namespace {

/// Values of a polynomial and of its first two derivatives.
struct Shape {
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};

Shape operator*(const Shape& a, const Shape& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope,
          a.curvature * b.value + 2.0 * a.slope * b.slope + a.value * b.curvature};
}

/// x^(2 n)
Shape even_power(double x, int n) {
  Shape out{1.0, 0.0, 0.0};
  for (int i = 0; i < n; ++i) out = out * Shape{x * x, 2.0 * x, 2.0};
  return out;
}

/// Bending moment of a plate of Poisson's ratio 1/2 over that in plane stress. Its length is 1 along the bending, its
/// width `width`; both ends are turned and stay straight across, as parts beside it that do not bend keep them. By
/// Ritz: the curvature that all share, and products of powers that vanish with their slopes at the ends.
double moment_of_hinge(double width) {
  constexpr double kRatio = 0.5;
  constexpr int kTerms = 7;
  constexpr int kPoints = 60;  // of the midpoint rule, in a quarter
  constexpr int kSize = kTerms * kTerms;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(kSize, kSize);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(kSize);
  Eigen::VectorXd along(kSize);
  Eigen::VectorXd across(kSize);
  Eigen::VectorXd twist(kSize);
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const double x = (i + 0.5) / kPoints;
      const double z = (j + 0.5) / kPoints;
      const Shape clamped = Shape{1.0 - x * x, -2.0 * x, -2.0} * Shape{1.0 - x * x, -2.0 * x, -2.0};
      for (int m = 0; m < kTerms; ++m) {
        const Shape f = clamped * even_power(x, m);
        for (int n = 0; n < kTerms; ++n) {
          const Shape g = even_power(z, n);
          along[m * kTerms + n] = 4.0 * f.curvature * g.value;
          across[m * kTerms + n] = 4.0 / (width * width) * f.value * g.curvature;
          twist[m * kTerms + n] = 4.0 / width * f.slope * g.slope;
        }
      }
      const double share = 1.0 / (kPoints * kPoints);
      stiffness += share * (along * along.transpose() + across * across.transpose() +
                            kRatio * (along * across.transpose() + across * along.transpose()) +
                            2.0 * (1.0 - kRatio) * twist * twist.transpose());
      load -= share * (along + kRatio * across);
    }
  }
  const Eigen::VectorXd found = stiffness.completeOrthogonalDecomposition().solve(load);
  return (1.0 - load.dot(found)) / (1.0 - kRatio * kRatio);
}

/// Share of the way from plane stress, 1, to plane strain, 4/3.
double share_of_way(double width) { return 3.0 * (moment_of_hinge(width) - 1.0); }

TEST(WideStrip, AHingeShorterThanItIsWideFlowsInPlaneStrain) {
  EXPECT_LT(share_of_way(0.1), 0.1) << "A long narrow bar is free.";
  scenes::record_figure("on the way to plane strain: as long as wide", share_of_way(1.0), 2);
  scenes::record_figure("on the way to plane strain: half as long", share_of_way(2.0), 2);
  scenes::record_figure("on the way to plane strain: a quarter as long", share_of_way(4.0), 2);
  EXPECT_GT(share_of_way(2.0), 0.75);
  EXPECT_GT(share_of_way(4.0), share_of_way(2.0));
}

/// Moment of a strip of width b that is bent to a radius R over that in plane stress (Ashwell, 1950): free sides turn
/// up, until that would stretch them. lambda^4 = 3 (1 - nu^2) / (R h)^2.
double moment_of_strip(double width, double thickness, double radius, double ratio) {
  const double angle = width * std::pow(3.0 * (1.0 - ratio * ratio), 0.25) / std::sqrt(radius * thickness);
  const double free = 2.0 / angle * (std::cosh(angle) - std::cos(angle)) / (std::sinh(angle) + std::sin(angle));
  return (1.0 - ratio * ratio * free) / (1.0 - ratio * ratio);
}

TEST(WideStrip, BendsElasticallyInPlaneStress) {
  EXPECT_NEAR(moment_of_strip(1.0, 1.0, 1e6, 0.3), 1.0, 1e-6);
  EXPECT_NEAR(moment_of_strip(1e3, 1.0, 1e3, 0.3), 1.0 / 0.91, 0.01);
  scenes::record_figure("the measured ring over plane stress", moment_of_strip(15.0, 4.04, 47.98, 0.3), 3, {1.0, 0.01});
}

/// Force of a wall along x that is pulled by a strain in 1 s, over h b.
double stress_at(MaterialSpec::Plane plane, double strain) {
  FrameLattice frame = scenes::bar(10.0, 1.0, 2);
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  frame.motions = {{1, FrameLattice::Component::x, {{0.0, 0.0}, {0.01, 10.0 * strain}}}};
  frame.watched_nodes = {0};
  frame.end_time_s = 0.01;
  SceneSpec spec = scenes::plastic_frame(frame, 70000.0, 70.0);
  spec.material.plane = plane;
  spec.material.poissons_ratio = 0.3;
  spec.material.hardening_modulus_mpa = 700.0;
  return -scenes::run_frame(spec).back().watched[0].reaction_x;
}

TEST(WideStrip, HasTheModulusOfPlaneStressAndTheFlowOfPlaneStrain) {
  using Plane = MaterialSpec::Plane;
  EXPECT_NEAR(stress_at(Plane::strip, 5e-4), 35.0, 0.1);
  EXPECT_NEAR(stress_at(Plane::strain, 5e-4), 35.0 / 0.91, 0.1);
  // sigma = sigma_y' + H' (strain - sigma / E), with sigma_y' = 2 sigma_y / sqrt(3), H' = 4 H / 3.
  const double hardening = 4.0 / 3.0 * 700.0;
  const double flow = (140.0 / std::numbers::sqrt3 + hardening * 0.02) / (1.0 + hardening / 70000.0);
  EXPECT_NEAR(stress_at(Plane::strip, 0.02), flow, 0.01 * flow);
  EXPECT_GT(flow, 1.1 * stress_at(Plane::stress, 0.02));
}

}  // namespace
}  // namespace cellcrush::strips
