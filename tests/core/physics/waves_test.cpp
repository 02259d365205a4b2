#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

// A mass strikes the end of a bar that is fixed at its other end: St Venant's problem (1883; Timoshenko and Goodier
// 1970, chapter 14). Waves run to and fro between the fixed end and the mass, which stays on the bar. Blind to:
// bending and contact.
namespace cellcrush::longitudinal_impact {
namespace {

constexpr double kModulus = 70000.0;  // of elastic_frame, MPa
constexpr double kDensity = 2.7e-9;
constexpr double kLength = 100.0;  // mm
constexpr double kThickness = 0.1;
constexpr double kSpeed = 500.0;  // mm/s
constexpr int kElements = 400;

double wave_speed() { return std::sqrt(kModulus / kDensity); }
double passage() { return 2.0 * kLength / wave_speed(); }           // T, there and back
double first_stress() { return kDensity * wave_speed() * kSpeed; }  // rho c V

/// Stress over rho c V of the wave that leaves the struck end at the time tau T, for the bar's mass over the striking
/// one. With a = 2 alpha, M dv/dt = -A (s(t) + s(t - T)) and rho c v = s(t) - s(t - T), so that from one passage to the
/// next s' + a s = s'(tau - 1) - a s(tau - 1), with a jump of rho c V at each.
double outgoing(double tau, double mass_ratio) {
  const double a = 2.0 * mass_ratio;
  double sum = 0.0;
  if (tau >= 0.0) sum += std::exp(-a * tau);
  if (tau >= 1.0) sum += std::exp(-a * (tau - 1.0)) * (1.0 - 2.0 * a * (tau - 1.0));
  if (tau >= 2.0) {
    const double x = a * (tau - 2.0);
    sum += std::exp(-x) * (1.0 - 4.0 * x + 2.0 * x * x);
  }
  return sum;
}

struct History {
  std::vector<double> tau;     // time over T
  std::vector<double> speed;   // of the mass, over V
  std::vector<double> stress;  // at the fixed end, compression, over rho c V
};

History strike(double mass_ratio, double duration) {
  const double mass = kDensity * kThickness * kLength / mass_ratio;
  const double own = kDensity * kThickness * kLength / (2.0 * kElements);
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength, 0.0, (mass - own) * 1e6, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, kElements)};
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  frame.initial_velocities = {{1, -1e-3 * kSpeed, 0.0, 0.0}};
  frame.end_time_s = duration * passage();
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  History history;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    history.tau.push_back(simulation.time() / passage());
    history.speed.push_back(-simulation.state().velocity[1].x() / kSpeed);
    history.stress.push_back(-simulation.state().internal_force[0].x() / kThickness / first_stress());
  }
  return history;
}

/// Mean of the values whose times lie in a range.
double mean(const History& history, const std::vector<double>& values, double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (history.tau[i] < from || history.tau[i] >= to) continue;
    sum += values[i];
    ++count;
  }
  return sum / count;
}

/// Holds the speed of the mass, the impulse of the fixed end and its stress between the fronts to theory; returns the
/// greatest stress over that of theory. The ringing of the mesh behind a front does not outlast T / 20: means over that
/// show the wave.
double expect_waves(double mass_ratio, double duration) {
  const History history = strike(mass_ratio, duration);
  const double step = history.tau[1] - history.tau[0];
  std::vector<double> exact_stress;
  double impulse = 0.0;  // over rho c V A T, of theory less that of the solver
  double worst_impulse = 0.0;
  double worst_speed = 0.0;
  for (std::size_t i = 0; i < history.tau.size(); ++i) {
    const double tau = history.tau[i] - 0.5 * step;  // of the velocity
    worst_speed =
        std::max(worst_speed, std::abs(history.speed[i] - outgoing(tau, mass_ratio) + outgoing(tau - 1.0, mass_ratio)));
    exact_stress.push_back(2.0 * outgoing(history.tau[i] - 0.5, mass_ratio));
    impulse += (exact_stress[i] - history.stress[i]) * step;
    worst_impulse = std::max(worst_impulse, std::abs(impulse));
  }
  double worst_stress = 0.0;
  double peak = 0.0;
  double exact_peak = 0.0;
  for (const double front : {0.5, 1.5, 2.5}) {
    for (double from = front + 0.02; from + 0.05 < std::min(front + 0.98, duration); from += 0.05) {
      const double stress = mean(history, history.stress, from, from + 0.05);
      const double exact = mean(history, exact_stress, from, from + 0.05);
      worst_stress = std::max(worst_stress, std::abs(stress - exact));
      peak = std::max(peak, stress);
      exact_peak = std::max(exact_peak, exact);
    }
  }
  EXPECT_NEAR(peak / exact_peak, 1.0, 0.01) << mass_ratio;
  scenes::record_bound("speed error", worst_speed, 8e-3);
  scenes::record_bound("impulse error", worst_impulse, 8e-3);
  scenes::record_bound("stress error", worst_stress, 0.04);
  return peak / exact_peak;
}

// The errors are what remains of the ringing behind the fronts, which a finer mesh narrows.
TEST(LongitudinalImpact, OfAMassOnABarHasTheStressesOfStVenant) {
  // Behind the second front the fixed end bears 2 (1 + exp(-2 alpha)) rho c V: Timoshenko and Goodier, alpha = 1.
  EXPECT_NEAR(2.0 * outgoing(1.0, 1.0), 2.0 * (1.0 + std::exp(-2.0)), 1e-12);
  scenes::record_figure("equal masses: greatest stress", expect_waves(1.0, 2.4), 3);
  scenes::record_figure("heavy mass: greatest stress", expect_waves(0.25, 2.9), 3);
}

}  // namespace
}  // namespace cellcrush::longitudinal_impact

// A plastic wave in a bilinear bar whose end is pulled at a constant speed: theory of Karman, Taylor and Rakhmatulin
// (Karman and Duwez 1950). An elastic wave of the strain of yield runs ahead, then comes the plastic wave, all strains
// above that of yield at c_p = sqrt(E_T / rho). Blind to: rate dependence, unloading waves, bending.
namespace cellcrush::plastic_wave {
namespace {

constexpr double kModulus = 70000.0;  // of elastic_frame, MPa
constexpr double kTangent = kModulus / 9.0;
constexpr double kYieldStress = 70.0;
constexpr double kDensity = 2.7e-9;
constexpr double kYieldStrain = kYieldStress / kModulus;
constexpr double kSpeed = 12e3;    // mm/s, at which the end is pulled
constexpr double kLength = 200.0;  // mm
constexpr double kThickness = 0.2;
constexpr int kElements = 400;
constexpr double kElement = kLength / kElements;

double stress_of(double strain) {
  return std::min(kModulus * strain, kYieldStress + kTangent * (strain - kYieldStrain));
}

/// Speed of a strain in the undeformed bar, mm/s. Stress and strain are nominal in tension (E5), so it is c_p.
double wave_speed(double strain) { return std::sqrt((strain < kYieldStrain ? kModulus : kTangent) / kDensity); }

/// Strain at which the end moves with `speed`: that is the integral of the wave speed over the strain.
double strain_at(double speed) {
  constexpr double kStep = 1e-7;
  double strain = 0.0;
  for (double sum = 0.0; sum < speed; strain += kStep) {
    sum += wave_speed(strain + 0.5 * kStep) * kStep;
  }
  return strain;
}

struct Profile {
  std::vector<double> strain;    // of pairs of elements
  std::vector<double> velocity;  // of their middle nodes, away from the bar
  double time = 0.0;
  double end_force = 0.0;  // N, mean over the last tenth of the time
};

/// Shape of the bar at two times, before the elastic wave arrives at the other end.
std::vector<Profile> pull() {
  const double end = 0.9 * kLength / wave_speed(0.0);
  const double rise = 12.0 * kElement / wave_speed(0.0);  // the speed rises linearly: less ringing
  FrameLattice frame = scenes::bar(kLength, kThickness, kElements);
  frame.supports = {{0, false, true, true}, {1, true, true, true}};
  FrameLattice::TimeFunction motion;
  for (int i = 0; i <= 24; ++i) motion.emplace_back(rise * i / 24.0, -0.5 * kSpeed * rise * (i / 24.0) * (i / 24.0));
  motion.emplace_back(2.0 * end, -kSpeed * (2.0 * end - 0.5 * rise));
  frame.motions = {{0, FrameLattice::Component::x, motion}};
  frame.end_time_s = end;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.material.yield_stress_mpa = kYieldStress;
  spec.material.hardening_modulus_mpa = kModulus * kTangent / (kModulus - kTangent);
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  std::vector<Profile> profiles;
  double impulse = 0.0;
  std::int64_t counted = 0;
  const std::int64_t steps = scene->schedule.step_count;
  for (std::int64_t step = 1; step <= steps; ++step) {
    simulation.advance(1);
    if (step > steps * 9 / 10) {
      impulse += simulation.state().internal_force[0].x();
      ++counted;
    }
    if (step != steps / 2 && step != steps) continue;
    Profile profile;
    profile.time = simulation.time();
    profile.end_force = counted > 0 ? impulse / static_cast<double>(counted) : 0.0;
    const auto place = [&](int i) { return simulation.state().position[i == 0 ? 0 : i == kElements ? 1 : i + 1].x(); };
    for (int i = 0; i + 2 <= kElements; i += 2) {
      profile.strain.push_back((place(i + 2) - place(i)) / (2.0 * kElement) - 1.0);
      profile.velocity.push_back(-simulation.state().velocity[i + 2].x());
    }
    profiles.push_back(profile);
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return profiles;
}

/// Where the strain last is above `level`, in the undeformed bar, mm.
double front(const Profile& profile, double level) {
  std::size_t i = profile.strain.size() - 1;
  while (i > 0 && profile.strain[i] < level) --i;
  const double share = (profile.strain[i] - level) / (profile.strain[i] - profile.strain[i + 1]);
  return (2.0 * (static_cast<double>(i) + share) + 1.0) * kElement;
}

/// Mean of values whose pairs lie between two places of the undeformed bar.
double mean(const std::vector<double>& values, double from, double to) {
  const auto first = static_cast<std::size_t>(from / (2.0 * kElement));
  const auto last = static_cast<std::size_t>(to / (2.0 * kElement));
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

TEST(PlasticWave, RunsAtTheSpeedOfTheTangentModulusBehindAnElasticOne) {
  const std::vector<Profile> profiles = pull();
  const double strain = strain_at(kSpeed);
  const Profile& last = profiles.back();
  const double time = last.time - profiles.front().time;
  const auto speed_of = [&](double level) { return (front(last, level) - front(profiles.front(), level)) / time; };
  const double plastic = 0.5 * (kYieldStrain + strain);
  const double plastic_front = front(last, plastic);
  const double elastic_front = front(last, 0.5 * kYieldStrain);
  const auto behind = [&](const std::vector<double>& values) {
    return mean(values, 0.1 * plastic_front, 0.8 * plastic_front);
  };
  const auto between = [&](const std::vector<double>& values) {
    return mean(values, 1.2 * plastic_front, 0.9 * elastic_front);
  };
  const double plastic_speed = speed_of(plastic) / wave_speed(plastic);
  const double elastic_speed = speed_of(0.5 * kYieldStrain) / wave_speed(0.5 * kYieldStrain);
  // Four times as many elements halve all errors; a front is about six elements wide.
  EXPECT_NEAR(behind(last.velocity) / kSpeed, 1.0, 1e-3);
  EXPECT_NEAR(between(last.strain) / kYieldStrain, 1.0, 0.006);
  EXPECT_NEAR(between(last.velocity) / (kYieldStrain * wave_speed(0.0)), 1.0, 0.004);
  const double force = last.end_force / (kThickness * stress_of(strain));
  scenes::record_figure("plastic speed", plastic_speed, 4, {1.0, 0.008});
  scenes::record_figure("elastic speed", elastic_speed, 4, {1.0, 0.004});
  scenes::record_figure("strain behind", behind(last.strain) / strain, 4, {1.0, 0.006});
  scenes::record_figure("force at the end", force, 4, {1.0, 0.003});
}

}  // namespace
}  // namespace cellcrush::plastic_wave
