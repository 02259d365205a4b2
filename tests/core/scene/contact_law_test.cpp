#include "scene/contact_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/state.h"
#include "scene/time_step.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

/// Speed of a ring of masses between springs and dampers, pushed as the stiffest mode moves, after steps of central
/// differences with viscous forces of the half step before, over that at the start.
double growth_of_ring(double stiffness, double damping, double mass, double step) {
  constexpr int kMasses = 20;
  std::vector<double> place(kMasses, 0.0);
  std::vector<double> speed(kMasses);
  for (int i = 0; i < kMasses; ++i) {
    speed[i] = i % 2 == 0 ? 1.0 : -1.0;
  }
  double most = 0.0;
  for (int k = 0; k < 400; ++k) {
    std::vector<double> force(kMasses, 0.0);
    for (int i = 0; i < kMasses; ++i) {
      const int next = (i + 1) % kMasses;
      const double pull = stiffness * (place[next] - place[i]) + damping * (speed[next] - speed[i]);
      force[i] += pull;
      force[next] -= pull;
    }
    for (int i = 0; i < kMasses; ++i) {
      speed[i] += step / mass * force[i];
      place[i] += step * speed[i];
    }
    most = k < 300 ? 0.0 : std::max(most, std::abs(speed[0]));
  }
  return most;
}

TEST(ContactLaw, ARowBetweenContactsIsStableUpToItsStep) {
  constexpr double kMass = 3e-6;
  constexpr double kStiffness = 2000.0;
  for (const double ratio : {0.0, 0.1, 0.2, 0.5, 1.0}) {
    const double damping = 2.0 * ratio * std::sqrt(kStiffness * 0.5 * kMass);  // of two masses kMass
    const double limit = contact_step_of({true, kStiffness, ratio, 0.0, 0.0}, kMass);
    EXPECT_LT(growth_of_ring(kStiffness, damping, kMass, 0.99 * limit), 20.0) << ratio;
    EXPECT_GT(growth_of_ring(kStiffness, damping, kMass, 1.01 * limit), 1e3) << ratio;
  }
}

TEST(ContactLaw, StiffnessFollowsTheMeshUntilTheSpeedAsksForMore) {
  const auto law_at = [](double speed, double time_step) {
    SceneSpec spec = scenes::hexagon_specimen(6, 5);
    spec.loading.speed_m_per_s = speed;
    spec.numerics.time_step_s = time_step;
    return scenes::build(spec);
  };
  const auto slow = law_at(1.0, 0.0);
  const double mass = std::ranges::min(slow->mass);
  const double of_elements = steps_of(*slow).of_elements;
  const double of_mesh = 0.12 * mass / (of_elements * of_elements);
  EXPECT_NEAR(slow->contact.stiffness, of_mesh, 1e-9 * of_mesh);
  EXPECT_EQ(law_at(50.0, 0.0)->contact.stiffness, slow->contact.stiffness);
  const double rate = 400e3 / (0.16 * 0.3464);  // V sqrt(m / k) = 0.16 h
  EXPECT_NEAR(law_at(400.0, 0.0)->contact.stiffness, mass * rate * rate, 1e-9 * mass * rate * rate);
  EXPECT_EQ(law_at(400.0, 1e-8)->contact.stiffness, law_at(400.0, 0.0)->contact.stiffness);
  const double held = 0.6 / 2e-7;  // the step cannot bear more
  EXPECT_NEAR(law_at(400.0, 2e-7)->contact.stiffness, mass * held * held, 1e-9 * mass * held * held);
}

// Contacts of stacked walls make more energy in slow crushes and on coarse meshes: the step is less there.
TEST(ContactLaw, StepOfStackedWallsFollowsSpeedAndMesh) {
  const auto phase_at = [](const char* lattice, int elements, double speed) {
    SceneSpec spec = scenes::spec_of({lattice, speed, 0.0}, 6, 4);
    spec.imperfection.amplitude_mm = 0.0;
    spec.elements_per_wall = elements;
    const auto scene = scenes::build(spec);
    return std::sqrt(scene->contact.stiffness / std::ranges::min(scene->mass)) * scene->schedule.time_step;
  };
  const Material metal = scenes::build(scenes::spec_of({"square", 1.0, 0.0}, 6, 4))->materials.front();
  const double fast = 1.44e-3 * std::sqrt(metal.yield_stress / metal.density);  // m/s, of one element per wall
  for (const char* lattice : {"square", "triangle"}) {
    for (const int elements : {2, 8}) {
      const double full = fast / elements;
      EXPECT_NEAR(phase_at(lattice, elements, 1.01 * full), 0.3, 1e-9) << lattice << " " << elements;
      EXPECT_NEAR(phase_at(lattice, elements, 0.5 * full), 0.15, 1e-9) << lattice << " " << elements;
      EXPECT_NEAR(phase_at(lattice, elements, 0.01 * full), 0.3 / 8.0, 1e-9) << lattice << " " << elements;
    }
  }
  EXPECT_GT(phase_at("hexagon", 2, 1.0), 0.3);
}

// Critical damping shortens the chosen step; at the step of a fifth of critical it makes energy.
TEST(ContactLaw, OverdampedContactIsSoundAtTheChosenStep) {
  SceneSpec spec = scenes::hexagon_specimen(12, 6);
  spec.loading.end_strain = 0.5;
  spec.contact.damping_ratio = 1.0;
  const auto scene = scenes::build(spec);
  EXPECT_EQ(scene->schedule.bound, StepBound::contacts);
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  const Sample sample = simulation.take_sample();
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished);
  EXPECT_GT(sample.energies.contact, 0.0);
  EXPECT_GT(sample.energies.contact_damping, 0.0);
  EXPECT_LT(sample.deepest_penetration, 0.1);
  EXPECT_LT(std::abs(sample.energies.residual), 0.01 * sample.energies.external);
}

}  // namespace
}  // namespace cellcrush
