#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cellcrush/state.h"
#include "scenes/crossings.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/small_specimen.h"

namespace cellcrush {
namespace {

using scenes::SmallSpecimen;

/// Small specimens crushed to 80 % at the chosen step.
class ContactSoundness : public testing::TestWithParam<SmallSpecimen> {
 protected:
  static SceneSpec spec() {
    SceneSpec spec = scenes::spec_of(GetParam(), 12, 6);
    spec.output.sample_count = 100;
    return spec;
  }
};

TEST_P(ContactSoundness, NoWallsCrossAndContactMakesNoEnergy) {
  const auto scene = scenes::build(spec());
  const SceneFacts facts = facts_of(*scene);
  Simulation simulation(scene);
  double least_contact_energy = 0.0;
  double largest_work = 0.0;
  Sample sample;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(facts.sample_interval);
    sample = simulation.take_sample();
    ASSERT_TRUE(scenes::find_crossings(*scene, simulation.state()).empty()) << "at strain " << sample.strain;
    EXPECT_GE(sample.energies.contact, -0.005 * sample.energies.external) << "at strain " << sample.strain;
    EXPECT_GE(sample.energies.contact_damping, 0.0);
    largest_work = std::max(largest_work, sample.energies.external);
    least_contact_energy = std::min(least_contact_energy, sample.energies.contact / largest_work);
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  EXPECT_NEAR(sample.strain, 0.8, 1e-3);
  EXPECT_LT(sample.deepest_penetration, 0.35);
  EXPECT_LT(simulation.state().contact_totals.deepest_birth, 0.12);
  EXPECT_LT(std::abs(sample.energies.residual), 0.01 * sample.energies.external);
  scenes::record_bound("penetration over h", sample.deepest_penetration);
  scenes::record_bound("penetration at first touch over h", simulation.state().contact_totals.deepest_birth);
  scenes::record_bound("negative contact work in %", 100.0 * least_contact_energy);
}

INSTANTIATE_TEST_SUITE_P(Crush, ContactSoundness,
                         testing::Values(SmallSpecimen{"hexagon", 25, 0.0}, SmallSpecimen{"hexagon", 100, 0.0},
                                         SmallSpecimen{"hexagon", 100, 0.3}, SmallSpecimen{"hexagon", 200, 0.0},
                                         SmallSpecimen{"hexagon", 200, 0.3}, SmallSpecimen{"square", 25, 0.3},
                                         SmallSpecimen{"square", 50, 0.0}, SmallSpecimen{"square", 100, 0.0},
                                         SmallSpecimen{"square", 100, 0.3}, SmallSpecimen{"square", 200, 0.0},
                                         SmallSpecimen{"square", 200, 0.3}, SmallSpecimen{"triangle", 25, 0.0},
                                         SmallSpecimen{"triangle", 50, 0.3}, SmallSpecimen{"triangle", 100, 0.0},
                                         SmallSpecimen{"triangle", 100, 0.3}, SmallSpecimen{"triangle", 200, 0.0},
                                         SmallSpecimen{"triangle", 200, 0.3}, SmallSpecimen{"square", 25, 0.0, 2},
                                         SmallSpecimen{"triangle", 25, 0.0, 2}),
                         scenes::name_of);

}  // namespace
}  // namespace cellcrush
