#include "scenes/dynamic_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::dynamic_frames {
namespace {

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

TEST(SpinningBar, KeepsItsAngularMomentum) {
  const auto scene = scenes::build(SpinningBar::spec(16, 60.0));
  Simulation simulation(scene);
  const double before = scenes::momentum_of(*scene, simulation.state()).angular;
  simulation.advance(scene->schedule.step_count);
  const double after = scenes::momentum_of(*scene, simulation.state()).angular;
  scenes::record_bound("relative change", after / before - 1.0, 1e-10);
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
    // Root mean square of the difference to the modes' sum, over the static deflection.
    double sum = 0.0;
    const auto samples = scenes::run_frame(cantilever.spec(elements, cantilever.first_period(), 0));
    for (const Sample& sample : samples) {
      sum += std::pow(sample.watched.front().uy - cantilever.deflection_at(sample.time), 2);
    }
    error.push_back(std::sqrt(sum / static_cast<double>(samples.size())) / cantilever.static_deflection);
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
    const SceneSpec spec = scenes::in_double_precision(cantilever.spec(4, cantilever.first_period(), steps));
    return first_mode(scenes::run_frame(spec)) / cantilever.static_deflection;
  };
  constexpr int kFewest = 400;
  const double converged = swing(64 * kFewest);
  std::vector<double> error;
  for (const int factor : {1, 2, 4}) {
    error.push_back(std::abs(swing(factor * kFewest) - converged));
  }
  for (std::size_t i = 1; i < error.size(); ++i) {
    const double order = std::log2(error[i - 1] / error[i]);
    EXPECT_NEAR(order, 2.0, 0.2) << error[i - 1] << " to " << error[i];
    if (i + 1 == error.size()) scenes::record_figure("order in the step", order, 2);
  }
}

/// Two equal elastic bars in line, the left of which runs into the right one at rest. Nodes are numbered from left to
/// right, elements + 1 a bar.
struct BarImpact {
  static constexpr double kLength = 100.0;  // mm, of either bar
  static constexpr double kThickness = 0.5;
  static constexpr double kGap = 0.001;     // mm
  static constexpr double kSpeed = 1000.0;  // mm / s
  static double duration() { return 2.0 * kLength / SpinningBar::wave_speed(); }

  static SceneSpec spec(int elements) {
    std::vector<Vector2> nodes;
    std::vector<std::pair<int, int>> beams;
    for (const double from : {0.0, kLength + kThickness + kGap}) {
      for (int i = 0; i <= elements; ++i) {
        const int node = static_cast<int>(nodes.size());
        if (i > 0) beams.emplace_back(node - 1, node);
        nodes.emplace_back(from + kLength * i / elements, 0.0);
      }
    }
    FrameLattice frame = scenes::touching_beams(nodes, beams, kThickness, 1);
    for (int i = 0; i <= elements; ++i) frame.initial_velocities.push_back({i, 1e-3 * kSpeed, 0.0, 0.0});
    frame.end_time_s = kGap / kSpeed + 2.0 * duration();
    SceneSpec spec = scenes::elastic_frame(std::move(frame));
    spec.contact.damping_ratio = 0.0;
    spec.contact.stiffness_factor = 0.25;
    spec.output.sample_count = 2000;
    return spec;
  }
};

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
  scenes::follow(simulation, [&](const State& state) {
    touching += state.contact_totals.count > 0 ? 1 : 0;
    collision.first_speed = speed_of(state, 0);
    collision.second_speed = speed_of(state, elements + 1);
    collision.momentum_drift =
        std::max(collision.momentum_drift, std::abs(collision.first_speed + collision.second_speed - 1.0));
  });
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
    const double restitution = collision.second_speed - collision.first_speed;
    EXPECT_LT(collision.momentum_drift, 1e-10) << elements;
    EXPECT_GT(restitution, elements > 10 ? 0.99 : 0.985) << elements;
    EXPECT_LE(restitution, 1.0) << elements;
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

// A mass strikes the middle of a perfectly plastic beam that is clamped at both ends. One end may slide along the beam,
// so that it only bends (Parkes 1958), or both are held, so that it is stretched too (Jones 1989). Blind to: rate
// dependence, and blows beside the middle.
constexpr double kHalf = 100.0;  // mm, half of the span
constexpr double kThickness = 4.0;
constexpr double kModulus = 200000.0;
constexpr double kYieldStress = 10.0;
constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;
constexpr double kMassPerLength = 7.85e-9 * kThickness;
constexpr double kBeamMass = 2.0 * kMassPerLength * kHalf;

/// The beam, whose middle node bears a mass of `ratio` times its own and starts at `speed` mm/s.
SceneSpec struck(double ratio, double speed, bool held, double end_time) {
  FrameLattice frame;
  constexpr int kElements = 16;  // of either half
  const double own = kMassPerLength * kHalf / kElements;
  frame.nodes = {
      {0.0, 0.0, 0.0, 0.0}, {kHalf, 0.0, (ratio * kBeamMass - own) * 1e6, 0.0}, {2.0 * kHalf, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, kElements), scenes::beam(1, 2, kThickness, kElements)};
  frame.supports = {{0, true, true, true}, {2, held, true, true}};
  frame.initial_velocities = {{1, 0.0, 1e-3 * speed, 0.0}};
  frame.watched_nodes = {1};
  frame.end_time_s = end_time;
  SceneSpec spec = scenes::plastic_frame(std::move(frame), kModulus, kYieldStress);
  spec.output.sample_count = 1000;
  return spec;
}

// Half of the beam is the struck cantilever of Parkes (1955) with half of the mass. It has M_p at both of its hinges,
// so 2 M_p stands where the cantilever has M_p (Parkes 1958). With M half of the striking mass, l half of the span and
// b = rho l / 2 M: w = M^2 V^2 / (6 rho M_p) (b / (1 + b) + 2 ln(1 + b)), at the time M V l / 2 M_p.
TEST(StruckBeam, WithSlidingEndsComesToRestWhereAndWhenParkesHasIt) {
  constexpr double kDeflection = 4.0;  // mm: the energy is 45 times what the beam can bear elastically
  for (const double ratio : {5.0, 20.0}) {
    const double mass = 0.5 * ratio * kBeamMass;
    const double light = kMassPerLength * kHalf / (2.0 * mass);
    const double shape = light / (1.0 + light) + 2.0 * std::log(1.0 + light);
    const double speed = std::sqrt(kDeflection * 6.0 * kMassPerLength * kFullMoment / shape) / mass;
    const double time = mass * speed * kHalf / (2.0 * kFullMoment);
    const std::vector<Sample> samples = scenes::run_frame(struck(ratio, speed, false, 3.0 * time));
    const scenes::Rest rest = scenes::rest_of(samples);
    EXPECT_NEAR(samples.back().energies.plastic / (mass * speed * speed), 1.0, 0.01) << ratio;
    const std::string name = ratio == 5.0 ? "mass of five beams: " : "mass of twenty beams: ";
    scenes::record_figure(name + "deflection", rest.deflection / kDeflection, 4, {1.0, 0.02});
    scenes::record_figure(name + "time", rest.time / time, 3, {1.0, 0.025});
  }
}

// Membrane forces: a beam that is held along its axis bears P = 4 M_p / l (1 + (w / h)^2) at its middle up to w = h,
// then 8 M_p w / l h (AxialForceWithMoment.Held). A mass much heavier than the beam comes to rest where its energy has
// done the work of that (Jones 1989).
TEST(StruckBeam, HeldAlongItsAxisComesToRestWhereMembraneForcesStopIt) {
  for (const double share : {1.0, 2.0}) {  // deflection over thickness
    const double ratio = 20.0;
    const double over_load = share <= 1.0 ? share + share * share * share / 3.0 : 4.0 / 3.0 + share * share - 1.0;
    const double work = 4.0 * kFullMoment / kHalf * kThickness * over_load;
    const double speed = std::sqrt(2.0 * work / (ratio * kBeamMass));
    const double time = ratio * kBeamMass * speed * kHalf / (4.0 * kFullMoment);  // of a beam that only bends
    const std::vector<Sample> samples = scenes::run_frame(struck(ratio, speed, true, 2.0 * time));
    const scenes::Rest rest = scenes::rest_of(samples);
    const double deflection = rest.deflection / (share * kThickness);
    EXPECT_NEAR(samples.back().energies.plastic / work, 1.0, 0.01) << share;
    scenes::record_figure(share == 1.0 ? "a thickness" : "two thicknesses", deflection, 4, {1.0, 0.02});
  }
}

}  // namespace
}  // namespace cellcrush::dynamic_frames
