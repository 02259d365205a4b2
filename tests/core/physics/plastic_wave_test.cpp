// A plastic wave in a bilinear bar whose end is pulled at a constant speed: theory of Karman, Taylor and Rakhmatulin
// (Karman and Duwez 1950). An elastic wave of the strain of yield runs ahead, then comes the plastic wave, all strains
// above that of yield at c_p = sqrt(E_T / rho). Blind to: rate dependence, unloading waves, bending.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

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
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, kElements)};
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
  EXPECT_NEAR(plastic_speed, 1.0, 0.008);
  EXPECT_NEAR(elastic_speed, 1.0, 0.004);
  EXPECT_NEAR(behind(last.strain) / strain, 1.0, 0.006);
  EXPECT_NEAR(behind(last.velocity) / kSpeed, 1.0, 1e-3);
  EXPECT_NEAR(between(last.strain) / kYieldStrain, 1.0, 0.006);
  EXPECT_NEAR(between(last.velocity) / (kYieldStrain * wave_speed(0.0)), 1.0, 0.004);
  const double force = last.end_force / (kThickness * stress_of(strain));
  EXPECT_NEAR(force, 1.0, 0.003);
  scenes::record_figure("plastic speed", plastic_speed, 4);
  scenes::record_figure("elastic speed", elastic_speed, 4);
  scenes::record_figure("strain behind", behind(last.strain) / strain, 4);
  scenes::record_figure("force at the end", force, 4);
}

}  // namespace
}  // namespace cellcrush::plastic_wave
