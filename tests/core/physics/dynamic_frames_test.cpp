#include "scenes/dynamic_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "cellcrush/state.h"
#include "scenes/dynamic_claims.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush {
namespace {

using scenes::BarImpact;
using scenes::SpinningBar;
using scenes::StepLoadedCantilever;
using scenes::StruckCantilever;

TEST(StruckCantilever, ComesToRestWhereAndWhenParkesHasIt) {
  const auto [deflection, time] =
      scenes::expect_parkes(scenes::run_frame(StruckCantilever::spec(20, 4.0 * StruckCantilever::duration())));
  scenes::record_figure("deflection", deflection, 4);
  scenes::record_figure("time", time, 4);
}

TEST(SpinningBar, StretchesBySteadyPullAndKeepsItsEnergy) {
  for (const int elements : {8, 16}) {
    const auto [stretch, drift] =
        scenes::expect_steady_stretch(scenes::run_frame(SpinningBar::spec(elements, 60.0)), elements);
    if (elements == 16) scenes::record_figure("stretch error in %", 100.0 * (stretch - 1.0), 1);
    scenes::record_bound("energy drift", drift);
  }
}

/// Momentum about the origin. With positions and velocities half a step apart it is kept to round-off by forces that
/// balance.
double angular_momentum(const Scene& scene, const State& state) {
  double sum = 0.0;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    sum += scene.mass[i] * cross(state.position[i], state.velocity[i]) + scene.inertia[i] * state.spin[i];
  }
  return sum;
}

TEST(SpinningBar, KeepsItsAngularMomentum) {
  const auto scene = scenes::build(SpinningBar::spec(16, 60.0));
  Simulation simulation(scene);
  const double before = angular_momentum(*scene, simulation.state());
  simulation.advance(scene->schedule.step_count);
  const double after = angular_momentum(*scene, simulation.state());
  scenes::record_bound("relative change", after / before - 1.0);
  EXPECT_NEAR(after / before, 1.0, 1e-10);
}

TEST(StepLoadedCantilever, SwingsToTwiceItsRestAsItsModesDo) {
  const StepLoadedCantilever cantilever;
  const double factor =
      scenes::expect_dynamic_factor(scenes::run_frame(cantilever.spec(16, cantilever.first_period(), 0)), cantilever);
  scenes::record_figure("dynamic load factor", factor, 4);
}

TEST(StepLoadedCantilever, ErrorFallsAsTheSquareOfTheElements) {
  const StepLoadedCantilever cantilever;
  std::vector<double> error;
  for (const int elements : {4, 8, 16, 32}) {
    error.push_back(
        scenes::modal_error(scenes::run_frame(cantilever.spec(elements, cantilever.first_period(), 0)), cantilever));
    RecordProperty("error_" + std::to_string(elements), std::to_string(error.back()));
  }
  for (std::size_t i = 1; i < error.size(); ++i) {
    const double order = std::log2(error[i - 1] / error[i]);
    EXPECT_NEAR(order, 2.0, 0.3) << error[i - 1] << " to " << error[i];
    if (i + 1 == error.size()) scenes::record_figure("order in elements", order, 2);
  }
}

/// Share of the first mode's swing in a deflection over one period: the modes above it, which short steps alone
/// resolve, fall out.
double first_mode(const std::vector<Sample>& samples) {
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i + 1) / static_cast<double>(samples.size());
    sum += 2.0 / static_cast<double>(samples.size()) * std::sin(turn) * samples[i].watched.front().uy;
  }
  return sum;
}

TEST(StepLoadedCantilever, ErrorOfItsFirstModeFallsAsTheSquareOfTheTimeStep) {
  StepLoadedCantilever cantilever;
  cantilever.length = 100.0;
  cantilever.thickness = 20.0;  // stocky: the stable step is no small part of the period
  cantilever.static_deflection = 0.001;
  const auto swing = [&](int steps) {
    SceneSpec spec = cantilever.spec(4, cantilever.first_period(), steps);
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
    return first_mode(scenes::run_frame(spec)) / cantilever.static_deflection;
  };
  constexpr int kFewest = 400;
  const double converged = swing(64 * kFewest);
  std::vector<double> error;
  for (const int factor : {1, 2, 4}) {
    error.push_back(std::abs(swing(factor * kFewest) - converged));
    RecordProperty("error_times_1e9_" + std::to_string(factor), std::to_string(1e9 * error.back()));
  }
  for (std::size_t i = 1; i < error.size(); ++i) {
    const double order = std::log2(error[i - 1] / error[i]);
    EXPECT_NEAR(order, 2.0, 0.2) << error[i - 1] << " to " << error[i];
    if (i + 1 == error.size()) scenes::record_figure("order in the step", order, 2);
  }
}

/// What the collision of two bars came to.
struct Collision {
  double first_speed = 0.0;  // of the bars after it, over V
  double second_speed = 0.0;
  double duration = 0.0;        // over 2 L / c
  double momentum_drift = 0.0;  // greatest change of the sum, over itself
};

Collision collide(int elements) {
  const auto scene = scenes::build(BarImpact::spec(elements));
  const auto speed_of = [&](const State& state, int first) {
    double momentum = 0.0;
    double mass = 0.0;
    for (int i = first; i <= first + elements; ++i) {
      momentum += scene->mass[i] * state.velocity[i].x();
      mass += scene->mass[i];
    }
    return momentum / mass / BarImpact::kSpeed;
  };
  Collision collision;
  Simulation simulation(scene);
  std::int64_t touching = 0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    touching += simulation.state().contact_totals.count > 0 ? 1 : 0;
    collision.first_speed = speed_of(simulation.state(), 0);
    collision.second_speed = speed_of(simulation.state(), elements + 1);
    collision.momentum_drift =
        std::max(collision.momentum_drift, std::abs(collision.first_speed + collision.second_speed - 1.0));
  }
  simulation.take_sample();
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  collision.duration = static_cast<double>(touching) * scene->schedule.time_step / BarImpact::duration();
  return collision;
}

TEST(BarImpact, OfEqualBarsHandsTheSpeedOnInTheTimeOfTwoWavePassages) {
  const std::vector<int> counts = {10, 20, 40, 80};
  std::vector<double> delay;
  for (const int elements : counts) {
    const Collision collision = collide(elements);
    const std::string name = std::to_string(elements);
    const double restitution = collision.second_speed - collision.first_speed;
    RecordProperty("restitution_" + name, std::to_string(restitution));
    RecordProperty("duration_" + name, std::to_string(collision.duration));
    EXPECT_LT(collision.momentum_drift, 1e-10) << name;
    EXPECT_GT(restitution, 0.99) << name;
    EXPECT_LE(restitution, 1.0) << name;
    delay.push_back(collision.duration - 1.0);
    if (elements == counts.back()) {
      scenes::record_figure("restitution", restitution, 3);
      scenes::record_figure("duration", collision.duration, 4);
    }
  }
  // The penalty is about as compliant as two elements, so that what it delays falls with their length. The dispersion
  // of lumped masses adds to it.
  const double order = std::log(delay.front() / delay.back()) / std::log(8.0);
  scenes::record_figure("order", order, 2);
  EXPECT_NEAR(order, 1.0, 0.2);
  EXPECT_LT(std::abs(delay.back()), 0.025);
}

}  // namespace
}  // namespace cellcrush
