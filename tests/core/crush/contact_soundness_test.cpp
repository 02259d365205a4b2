#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cellcrush/state.h"
#include "scenes/crossings.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

struct Case {
  const char* lattice;
  double speed;     // m/s
  double friction;  // of walls and plates
};

/// Small blocks at relative density 0.1, crushed to 80 % at the chosen step.
class ContactSoundness : public testing::TestWithParam<Case> {
 protected:
  static SceneSpec spec() {
    SceneSpec spec = scenes::hexagon_block(12, 6);
    const std::string lattice = GetParam().lattice;
    if (lattice == "square") {
      spec.lattice = SquareLattice{12, 6, 4.0, 0.05132 * 4.0};
    } else if (lattice == "triangle") {
      spec.lattice = TriangleLattice{12, 6, 4.0, 0.02963 * 4.0};
    }
    spec.loading.speed_m_per_s = GetParam().speed;
    spec.contact.friction = spec.plates.friction = GetParam().friction;
    spec.imperfection = {0.01, 1};
    spec.numerics.time_step_s = 0.0;
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
    EXPECT_GE(sample.energy_contact, -0.005 * sample.work_external) << "at strain " << sample.strain;
    EXPECT_GE(sample.energy_contact_damping, 0.0);
    largest_work = std::max(largest_work, sample.work_external);
    least_contact_energy = std::min(least_contact_energy, sample.energy_contact / largest_work);
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  EXPECT_NEAR(sample.strain, 0.8, 1e-3);
  EXPECT_LT(sample.deepest_penetration, 0.25);
  EXPECT_LT(simulation.state().deepest_birth, 0.10);
  EXPECT_LT(std::abs(sample.energy_residual), 0.01 * sample.work_external);
  RecordProperty("deepest_penetration", std::to_string(sample.deepest_penetration));
  RecordProperty("deepest_birth", std::to_string(simulation.state().deepest_birth));
  RecordProperty("least_contact_energy_relative", std::to_string(least_contact_energy));
  RecordProperty("contact_damping_relative", std::to_string(sample.energy_contact_damping / sample.work_external));
}

std::string name_of(const testing::TestParamInfo<Case>& test) {
  return std::string(test.param.lattice) + "At" + std::to_string(static_cast<int>(test.param.speed)) +
         (test.param.friction > 0.0 ? "WithFriction" : "");
}

INSTANTIATE_TEST_SUITE_P(Crush, ContactSoundness,
                         testing::Values(Case{"hexagon", 25, 0.0}, Case{"hexagon", 100, 0.0}, Case{"hexagon", 100, 0.3},
                                         Case{"hexagon", 200, 0.0}, Case{"hexagon", 200, 0.3}, Case{"square", 25, 0.3},
                                         Case{"square", 50, 0.0}, Case{"square", 100, 0.0}, Case{"square", 100, 0.3},
                                         Case{"square", 200, 0.0}, Case{"square", 200, 0.3}, Case{"triangle", 25, 0.0},
                                         Case{"triangle", 50, 0.3}, Case{"triangle", 100, 0.0},
                                         Case{"triangle", 100, 0.3}, Case{"triangle", 200, 0.0},
                                         Case{"triangle", 200, 0.3}),
                         name_of);

}  // namespace
}  // namespace cellcrush
