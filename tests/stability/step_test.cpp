// Steps that are too long: each run as one that nobody watches, and as one that is sampled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "cellcrush/state.h"
#include "scene/time_step.h"
#include "scenes/crushes.h"
#include "scenes/dynamic_frames.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "stability/watched_run.h"

namespace cellcrush {
namespace {

using stability::WatchedRun;
using Kind = RunStatus::Kind;

/// A small specimen whose run is in steps of `share` of the stable one, as if nothing else bounded them; 0: the chosen
/// step.
std::shared_ptr<Scene> specimen(const char* lattice, double speed, double share, double end_strain = 0.8,
                                double stiffness_factor = 0.12, int elements = 2, double hardening = 0.0) {
  SceneSpec spec = scenes::spec_of({lattice, speed, 0.0}, 12, 6);
  spec.material.hardening_modulus_mpa = hardening;
  spec.elements_per_wall = elements;
  spec.loading.end_strain = end_strain;
  spec.contact.stiffness_factor = stiffness_factor;
  spec.output.sample_count = 200;
  auto scene = scenes::build(spec);
  if (share > 0.0) {
    Schedule& schedule = scene->schedule;
    const double end = static_cast<double>(schedule.step_count) * schedule.time_step;
    schedule.time_step = share * scene->stable_step;
    schedule.step_count = std::llround(end / schedule.time_step);
    schedule.sample_interval = std::max<std::int64_t>(1, schedule.step_count / 200);
  }
  return scene;
}

/// The state at the end of a run that nobody looks at: no check can end it.
State unwatched(const std::shared_ptr<Scene>& scene) {
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  return simulation.state();
}

bool is_finite(const FieldFrame& frame) {
  return std::all_of(frame.position.begin(), frame.position.end(), [](float value) { return std::isfinite(value); });
}

void expect_named(const WatchedRun& run) {
  EXPECT_NE(run.status.message.find("step " + std::to_string(run.step)), std::string::npos) << run.status.message;
  EXPECT_NE(run.status.message.find("particle "), std::string::npos) << run.status.message;
  EXPECT_NE(run.status.message.find("mm before loading"), std::string::npos) << run.status.message;
  EXPECT_NE(run.status.remedy.find("numerics.time_step_s"), std::string::npos) << run.status.remedy;
}

void expect_last_good_is_kept(const WatchedRun& run) {
  EXPECT_TRUE(is_finite(run.last_good));
  EXPECT_EQ(run.last_good.position.size(), 2 * run.scene->particle_count());
  EXPECT_LT(run.last_good.time, static_cast<double>(run.step) * run.scene->schedule.time_step);
  if (!run.samples.empty()) {
    EXPECT_LE(run.last_good.time, run.samples.back().time);
    EXPECT_GE(run.last_good.strain, run.samples.back().strain - 0.011);
  }
}

// Plasticity takes what the instability makes: no motion is seen that a sound crush does not show as well. Only the
// ledger tells.
TEST(StepBeyondTheLimit, HidesItsEnergyAsPlasticHeatAndOnlyTheLedgerShowsIt) {
  const WatchedRun sound(specimen("hexagon", 100.0, 0.0));
  EXPECT_EQ(sound.status.kind, Kind::finished);
  EXPECT_LT(sound.summary.energy_error_relative, 0.01);
  EXPECT_TRUE(sound.summary.warnings.empty());

  const auto scene = specimen("hexagon", 100.0, 1.002);
  const State state = unwatched(scene);
  for (const Vector2& velocity : state.velocity) {
    EXPECT_LT(velocity.norm(), 10.0 * scene->plates.speed);
  }
  EXPECT_EQ(WatchedRun(scene).status.kind, Kind::energy_balance);
}

// Neither does the plastic work over the mean of both yield surfaces of hardening walls hide it.
TEST(StepBeyondTheLimit, EndsByNameWithItsStepItsPlaceAndTheLastGoodFrame) {
  for (const auto& [share, hardening] : {std::pair(1.1, 0.0), {1.5, 0.0}, {3.0, 0.0}, {1.3, 700.0}, {1.3, 7000.0}}) {
    const WatchedRun run(specimen("hexagon", 100.0, share, 0.8, 0.12, 2, hardening));
    EXPECT_TRUE(run.status.kind == Kind::energy_balance || run.status.kind == Kind::contact_energy) << share;
    expect_named(run);
    expect_last_good_is_kept(run);
  }
  for (const double hardening : {700.0, 7000.0}) {
    const WatchedRun sound(specimen("hexagon", 100.0, 0.7, 0.8, 0.12, 2, hardening));
    EXPECT_EQ(sound.status.kind, Kind::finished) << hardening;
  }
}

// Without flow nothing takes the energy, and the motion grows without bound.
TEST(StepBeyondTheLimit, OfAnElasticStructureGrowsWithoutBound) {
  constexpr double kStir = 1.0;  // mm/s
  auto scene = specimen("hexagon", 100.0, 1.3);
  scene->materials.front().yield_stress = 1e30;
  scene->contact.present = scene->plates.present = false;
  scenes::stir(*scene, kStir);
  scene->schedule.step_count = 40;
  scene->schedule.sample_interval = 10;
  double fastest = 0.0;
  for (const Vector2& velocity : unwatched(scene).velocity) {
    fastest = std::max(fastest, velocity.norm());
  }
  EXPECT_GT(fastest, 1e6 * kStir);
  const WatchedRun run(scene);
  EXPECT_EQ(run.status.kind, Kind::large_rotation) << run.status.message;
  expect_named(run);
  expect_last_good_is_kept(run);
}

TEST(NonFiniteMotion, EndsTheRunByNameAndKeepsTheLastFrameOfNumbers) {
  const auto scene = specimen("hexagon", 100.0, 0.0);
  scene->initial_velocity.assign(scene->particle_count(), Vector2::Zero());
  scene->initial_velocity[5].x() = std::numeric_limits<double>::infinity();
  const State state = unwatched(scene);
  EXPECT_GT(std::count_if(state.position.begin(), state.position.end(),
                          [](const Vector2& position) { return !position.allFinite(); }),
            200);  // it has spread
  const WatchedRun run(scene);
  EXPECT_EQ(run.status.kind, Kind::diverged);
  expect_named(run);
  expect_last_good_is_kept(run);
}

// 400 m/s in steps of 0.9 of the stable one: the plate moves by a quarter of a wall in a step, walls are born deep in
// each other and thrown through. The ledger books what contacts make like any other work and closes.
TEST(StepTooLongForTheSpeed, MakesAThousandTimesTheWorkUnlessContactsAreWatched) {
  const State sound = unwatched(specimen("hexagon", 400.0, 0.0));
  const State state = unwatched(specimen("hexagon", 400.0, 0.9));
  EXPECT_GT(state.ledger.external, 100.0 * sound.ledger.external);
  EXPECT_GE(state.crossing_step, 0);
  for (const char* lattice : {"hexagon", "square", "triangle"}) {
    const WatchedRun run(specimen(lattice, 400.0, 0.9));
    EXPECT_EQ(run.status.kind, Kind::contact_energy) << lattice << run.status.message;
    expect_named(run);
    expect_last_good_is_kept(run);
    const WatchedRun chosen(specimen(lattice, 400.0, 0.0, 0.4));
    EXPECT_EQ(chosen.status.kind, Kind::finished) << lattice << chosen.status.message;
    scenes::record_bound("residual at the chosen step in %", 100.0 * chosen.summary.energy_error_relative, 1.0);
    EXPECT_FALSE(chosen.warns_of(Warning::Kind::contact_energy)) << lattice;
  }
}

// At the longest step that may be given the law of contact is as soft as that step wants, and walls sink in deeper.
TEST(StepTooLongForTheSpeed, IsAWarningWhileWallsAreOnlyDeep) {
  SceneSpec spec = scenes::spec_of({"hexagon", 800.0, 0.0}, 12, 6);
  spec.numerics.time_step_s = 2.26e-7;
  spec.output.sample_count = 200;
  const WatchedRun run(scenes::build(spec));
  EXPECT_EQ(run.status.kind, Kind::finished) << run.status.message;
  EXPECT_GT(run.summary.deepest_penetration, 0.5);
  ASSERT_TRUE(run.warns_of(Warning::Kind::deep_penetration));
  for (const Warning& warning : run.summary.warnings) {
    EXPECT_NE(warning.message.find("step "), std::string::npos) << warning.message;
    EXPECT_FALSE(warning.remedy.empty());
  }
  EXPECT_NE(run.summary.warnings.front().message.find("particle "), std::string::npos)
      << run.summary.warnings.front().message;
}

// Contacts far too soft for the speed: V sqrt(m / k) is several thicknesses, and walls pass through each other without
// making energy.
TEST(ContactTooSoftForTheSpeed, EndsTheRunWhenAWallHasPassedThroughAnother) {
  const auto scene = specimen("hexagon", 200.0, 0.0);
  scene->contact.stiffness *= 0.01;
  const WatchedRun run(scene);
  EXPECT_EQ(run.status.kind, Kind::wall_crossing) << run.status.message;
  EXPECT_NE(run.status.message.find("passed through another at step "), std::string::npos) << run.status.message;
  EXPECT_NE(run.status.message.find("particle "), std::string::npos) << run.status.message;
  expect_last_good_is_kept(run);
}

/// A blow in the middle of the run that sets every joint turning at up to 40000 rad/s: the walls yield.
void strike_joints(Scene& scene) {
  const double step = scene.schedule.time_step;
  const double time = 0.5 * static_cast<double>(scene.schedule.step_count) * step;
  std::mt19937 random(1);
  for (int joint = 0; joint < scene.joint_count; ++joint) {
    const double spin = 4e4 * (static_cast<double>(random()) / 0x80000000p0 - 1.0);
    const double moment = spin * scene.inertia[joint] / step;
    scene.loads.push_back({joint, Component::rotation, {{{time - step, 0.0}, {time, moment}, {time + step, 0.0}}}});
  }
}

// At more than 1 / sqrt(2) of the stable step, modes that turn the joints repeat after four steps. End forces that do
// other work than the sections feed walls that yield in such a cycle; those of E5h do not.
TEST(CycleOfFourSteps, DiesOutUpToNineTenthsOfTheStableStep) {
  const auto struck = [](const char* lattice, int elements, double share) {
    const auto scene = specimen(lattice, 4.0, share, 0.2, 0.12, elements);
    strike_joints(*scene);
    return WatchedRun(scene);
  };
  for (const auto& [lattice, elements] :
       {std::pair("hexagon", 1), {"hexagon", 2}, {"hexagon", 8}, {"square", 4}, {"triangle", 4}}) {
    for (const double share : {kForceBasedStepFraction, 0.9}) {
      SCOPED_TRACE(::testing::Message() << lattice << ", " << elements << " elements, " << share);
      const WatchedRun run = struck(lattice, elements, share);
      EXPECT_EQ(run.status.kind, Kind::finished) << run.status.message;
      const Sample& end = run.samples.back();
      const auto after = std::ranges::find_if(run.samples, [](const Sample& sample) { return sample.strain > 0.11; });
      ASSERT_NE(after, run.samples.end());
      EXPECT_NEAR(end.energies.residual, after->energies.residual, 0.002 * end.energies.external);
    }
  }
}

/// Energy that contacts had made by a sample, as the greatest fraction of the work done by then.
double most_made_by_contacts(const WatchedRun& run) {
  double most = 0.0;
  for (const Sample& sample : run.samples) {
    most = std::max(most, -sample.energies.contact / sample.energies.external);
  }
  return most;
}

// Walls stacked along the crush ring among their contacts: at 0.9 of the step that a single one would bear they make
// energy. That step is the stable one of an element, 0.58 of a pair's.
TEST(DensifiedStack, MakesEnergyAtTheStepThatASingleContactBears) {
  const double single = 1.0;  // stiffness over m / dt_crit^2: omega dt = 0.9 for one particle between contacts
  const WatchedRun ringing(specimen("triangle", 25.0, 0.52, 0.8, single));
  EXPECT_EQ(ringing.status.kind, Kind::finished) << ringing.status.message;
  EXPECT_GT(most_made_by_contacts(ringing), 0.005);
  const WatchedRun sound(specimen("triangle", 25.0, 0.29, 0.8, single));
  EXPECT_EQ(sound.status.kind, Kind::finished) << sound.status.message;
  EXPECT_LT(most_made_by_contacts(sound), 0.001);
  EXPECT_FALSE(sound.warns_of(Warning::Kind::energy_drift));
  const SceneFacts chosen = facts_of(*specimen("triangle", 25.0, 0.0, 0.8, single));
  EXPECT_LT(chosen.time_step, 0.5 * chosen.stable_step);
}

// A bar that turns by 0.3 rad in a step is torn by its own spin; one that turns by more than half a turn is seen
// turning the other way (LargeIncrements.BeyondHalfATurnAreSeenAsTheOtherWay).
TEST(LargeIncrements, EndTheRunByName) {
  const auto scene = scenes::build(scenes::SpinningBar::spec(8, 4.0));
  const double spin = 0.3 / scene->schedule.time_step;
  for (std::size_t i = 0; i < scene->particle_count(); ++i) {
    scene->initial_spin[i] = spin;
    scene->initial_velocity[i] = Vector2(0.0, spin * scene->position[i].x());
  }
  scene->schedule.sample_interval = 1;
  const WatchedRun run(scene);
  EXPECT_EQ(run.status.kind, Kind::large_rotation) << run.status.message;
  expect_named(run);
}

}  // namespace
}  // namespace cellcrush
