// Natural frequencies of bars and beams. A frame swings in one of its modes; its frequency is held to the eigenvalues
// of an independent assembly of cubic beams with the lumped masses of E1, and to the continuous beam with rotary
// inertia (Rayleigh 1877), for which the order of convergence is measured. Blind to: large motions, and what damps.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::frequencies {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr double kLength = 100.0;  // mm
constexpr double kThickness = 4.0;
constexpr double kModulus = 70000.0;  // of elastic_frame, MPa
constexpr double kMassPerLength = 2.7e-9 * kThickness;
constexpr double kStiffness = kModulus * kThickness * kThickness * kThickness / 12.0;
constexpr double kGyration2 = kThickness * kThickness / 12.0;

enum class Kind { simply_supported, cantilever, axial };

/// Modes of a beam of an even number of elements, by ascending frequency. Degrees of freedom: u of each node (along the
/// bar or across it), then the rotations of all nodes. Nodes inside pairs turn without inertia (E5b).
class Modes {
 public:
  Modes(Kind kind, int elements) : elements_(elements), length_(kLength / elements) {
    const int nodes = elements + 1;
    const MatrixXd stiffness = kind == Kind::axial ? bar_stiffness() : beam_stiffness();
    VectorXd mass = VectorXd::Zero(2 * nodes);
    for (int i = 0; i < nodes; ++i) {
      const double here = kMassPerLength * length_ * (i == 0 || i == elements ? 0.5 : 1.0);
      mass[i] = here;
      if (i % 2 == 0) {
        mass[nodes + i] += here * kGyration2;
      } else {
        for (const int end : {i - 1, i + 1}) mass[nodes + end] += 0.5 * here * kGyration2;
      }
    }
    std::vector<int> moving;
    std::vector<int> massless;
    for (int i = 0; i < 2 * nodes; ++i) {
      if (kind == Kind::axial && i >= nodes) continue;
      const bool held =
          i == 0 || (kind == Kind::cantilever && i == nodes) || (kind == Kind::simply_supported && i == elements);
      if (!held) (mass[i] > 0.0 ? moving : massless).push_back(i);
    }
    MatrixXd condensed = stiffness(moving, moving);
    if (!massless.empty() && kind != Kind::axial) {
      condensed -=
          stiffness(moving, massless) * stiffness(massless, massless).ldlt().solve(stiffness(massless, moving));
    }
    const VectorXd of_moving = mass(moving);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(condensed, of_moving.asDiagonal().toDenseMatrix());
    frequencies_ = solver.eigenvalues().cwiseSqrt();
    shapes_ = MatrixXd::Zero(2 * nodes, solver.eigenvalues().size());
    for (std::size_t i = 0; i < moving.size(); ++i) shapes_.row(moving[i]) = solver.eigenvectors().row(i);
    mass_ = mass;
  }

  [[nodiscard]] double frequency(int mode) const { return frequencies_[mode - 1]; }
  [[nodiscard]] VectorXd shape(int mode) const { return shapes_.col(mode - 1); }
  /// What a motion has of a mode.
  [[nodiscard]] double share(int mode, const VectorXd& motion) const {
    return shapes_.col(mode - 1).cwiseProduct(mass_).dot(motion);
  }

 private:
  [[nodiscard]] MatrixXd bar_stiffness() const {
    MatrixXd sum = MatrixXd::Zero(2 * elements_ + 2, 2 * elements_ + 2);
    const double k = kModulus * kThickness / length_;
    for (int i = 0; i < elements_; ++i) {
      sum.block<2, 2>(i, i) += (Eigen::Matrix2d() << k, -k, -k, k).finished();
    }
    return sum;
  }
  [[nodiscard]] MatrixXd beam_stiffness() const {
    const int nodes = elements_ + 1;
    MatrixXd sum = MatrixXd::Zero(2 * nodes, 2 * nodes);
    const double l = length_;
    Eigen::Matrix4d k;  // w1, w2, rotation 1, rotation 2
    k << 12.0, -12.0, 6.0 * l, 6.0 * l, -12.0, 12.0, -6.0 * l, -6.0 * l, 6.0 * l, -6.0 * l, 4.0 * l * l, 2.0 * l * l,
        6.0 * l, -6.0 * l, 2.0 * l * l, 4.0 * l * l;
    k *= kStiffness / (l * l * l);
    for (int i = 0; i < elements_; ++i) {
      const std::vector<int> at = {i, i + 1, nodes + i, nodes + i + 1};
      sum(at, at) += k;
    }
    return sum;
  }

  int elements_;
  double length_;
  VectorXd frequencies_;
  VectorXd mass_;
  MatrixXd shapes_;
};

/// Frequency of the continuous bar or beam, 1/s.
double continuous_frequency(Kind kind, int mode) {
  if (kind == Kind::axial) return std::sqrt(kModulus / 2.7e-9) * (mode - 0.5) * pi / kLength;
  const double speed = std::sqrt(kStiffness / kMassPerLength);
  if (kind == Kind::simply_supported) {
    const double k = mode * pi / kLength;
    return speed * k * k / std::sqrt(1.0 + kGyration2 * k * k);
  }
  // w'''' + g w'' - (omega / speed)^2 w = 0 with g = gamma^2 (omega / speed)^2: w of cosh a, cos b, sinh a / a,
  // sin b / b. No displacement and turn at the clamp; no moment w'' and shear w''' + g w' at the tip.
  const auto determinant = [&](double omega) {
    const double square = std::pow(omega / speed, 2);
    const double g = kGyration2 * square;
    const double root = std::sqrt(0.25 * g * g + square);
    const double a = std::sqrt(root - 0.5 * g);
    const double b = std::sqrt(root + 0.5 * g);
    const double ch = std::cosh(a * kLength);
    const double sh = std::sinh(a * kLength);
    const double c = std::cos(b * kLength);
    const double s = std::sin(b * kLength);
    const double moment_even = a * a * ch + b * b * c;
    const double moment_odd = a * sh + b * s;
    const double shear_even = a * a * a * sh - b * b * b * s + g * (a * sh + b * s);
    const double shear_odd = a * a * ch + b * b * c + g * (ch - c);
    return moment_even * shear_odd - moment_odd * shear_even;
  };
  const double root = mode == 1 ? 1.875104 : (mode - 0.5) * pi;
  double low = 0.8 * speed * root * root / (kLength * kLength);
  double high = 1.02 * speed * root * root / (kLength * kLength);
  EXPECT_LT(determinant(low) * determinant(high), 0.0) << mode;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (determinant(low) * determinant(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

/// Frequency with which the solver's beam swings in a mode, 1/s, without what central differences add: from the time of
/// ten zero crossings.
double measured_frequency(Kind kind, int elements, int mode) {
  const Modes modes(kind, elements);
  FrameLattice frame = scenes::bar(kLength, kThickness, elements);
  frame.supports = {{0, true, true, kind != Kind::simply_supported}};
  if (kind == Kind::simply_supported) frame.supports.push_back({1, false, true, false});
  frame.end_time_s = 6.0 * 2.0 * pi / modes.frequency(mode);
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(frame));
  if (kind == Kind::axial) spec.numerics.time_step_s = 2.0 * pi / modes.frequency(mode) / 1000.0;  // to interpolate
  const auto scene = scenes::build(spec);
  const int nodes = elements + 1;
  const auto particle = [&](int i) { return i == 0 ? 0 : i == elements ? 1 : i + 1; };
  const VectorXd shape = modes.shape(mode);
  const double speed = 1e-5 * kThickness * modes.frequency(mode) / shape.head(nodes).cwiseAbs().maxCoeff();
  const int axis = kind == Kind::axial ? 0 : 1;
  scene->initial_velocity.assign(nodes, Vector2::Zero());
  scene->initial_spin.assign(nodes, 0.0);
  for (int i = 0; i < nodes; ++i) {
    scene->initial_velocity[particle(i)][axis] = speed * shape[i];
    scene->initial_spin[particle(i)] = speed * shape[nodes + i];
  }
  Simulation simulation(scene);
  const double step = scene->schedule.time_step;
  std::vector<double> crossings;
  double before = 0.0;
  VectorXd motion(2 * nodes);
  while (crossings.size() < 11 && simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    for (int i = 0; i < nodes; ++i) {
      motion[i] = simulation.state().position[particle(i)][axis] - scene->position[particle(i)][axis];
      motion[nodes + i] = simulation.state().rotation[particle(i)];
    }
    const double now = modes.share(mode, motion);
    if (now * before < 0.0) crossings.push_back(simulation.time() - step * now / (now - before));
    before = now;
  }
  EXPECT_EQ(crossings.size(), 11u);
  const double frequency = 10.0 * pi / (crossings.back() - crossings.front());
  return 2.0 / step * std::sin(0.5 * frequency * step);
}

/// Holds modes 1 to 3 to the eigenvalues of the mesh, and their errors against the continuous beam to an order of
/// convergence: 16 and 32 elements.
void expect_frequencies(Kind kind, double order, double bound) {
  double worst = 0.0;
  double least_order = 100.0;
  double finest = 0.0;
  for (const int mode : {1, 2, 3}) {
    double error[2];
    for (const int i : {0, 1}) {
      const int elements = 16 << i;
      const double frequency = measured_frequency(kind, elements, mode);
      worst = std::max(worst, std::abs(frequency / Modes(kind, elements).frequency(mode) - 1.0));
      error[i] = frequency / continuous_frequency(kind, mode) - 1.0;
    }
    EXPECT_LT(std::abs(error[1]), bound) << mode;
    const double measured_order = std::log2(error[0] / error[1]);
    EXPECT_NEAR(measured_order, order, 0.1 * order) << mode;
    least_order = std::min(least_order, measured_order);
    finest = std::max(finest, std::abs(error[1]));
  }
  scenes::record_bound("error against the mesh", worst,
                       2e-6);  // a wall that is pulled is a little stiffer than one that is pressed: strains of E5
  scenes::record_figure("error in %", 100.0 * finest, 2);
  scenes::record_figure("least order", least_order, 2);
}

// Condensed, cubic beams with lumped masses are of fourth order; half masses at a free end make them of second order.
TEST(Frequencies, OfASimplySupportedBeamConvergeWithFourthOrder) {
  expect_frequencies(Kind::simply_supported, 4.0, 1e-5);
}

TEST(Frequencies, OfACantileverConvergeWithSecondOrder) { expect_frequencies(Kind::cantilever, 2.0, 3e-3); }

TEST(Frequencies, OfAxialWavesConvergeWithSecondOrder) {
  expect_frequencies(Kind::axial, 2.0, 3e-3);
  // A lumped bar has them in closed form: 2 c / l sin((n - 1/2) pi / 2 N).
  const double speed = std::sqrt(kModulus / 2.7e-9);
  const double closed = 2.0 * speed * 16.0 / kLength * std::sin(2.5 * pi / 32.0);
  EXPECT_NEAR(Modes(Kind::axial, 16).frequency(3) / closed, 1.0, 1e-12);
}

}  // namespace
}  // namespace cellcrush::frequencies
