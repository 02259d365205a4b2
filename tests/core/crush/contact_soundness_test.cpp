#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "contact/contact_forces.h"
#include "contact/contact_tiles.h"
#include "contact/search/pair_search.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/near_pairs.h"

namespace cellcrush {
namespace {

using scenes::SmallSpecimen;

constexpr auto kNames = [](const ::testing::TestParamInfo<SmallSpecimen>& test) { return scenes::name_of(test); };

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
  Simulation simulation(scene);
  double least_contact_energy = 0.0;
  double largest_work = 0.0;
  Sample sample;
  scenes::watch(simulation, [&](const Sample& now) {
    sample = now;
    ASSERT_TRUE(scenes::find_crossings(*scene, simulation.state()).empty()) << "at strain " << sample.strain;
    EXPECT_GE(sample.energies.contact, -0.005 * sample.energies.external) << "at strain " << sample.strain;
    EXPECT_GE(sample.energies.contact_damping, 0.0);
    largest_work = std::max(largest_work, sample.energies.external);
    least_contact_energy = std::min(least_contact_energy, sample.energies.contact / largest_work);
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  EXPECT_NEAR(sample.strain, 0.8, 1e-3);
  EXPECT_LT(std::abs(sample.energies.residual), 0.01 * sample.energies.external);
  scenes::record_bound("penetration over h", sample.deepest_penetration, 0.35);
  scenes::record_bound("penetration at first touch over h", simulation.state().contact_totals.deepest_birth, 0.12);
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
                         kNames);

/// Small specimens crushed to 60 %, every few steps held against the search by buckets.
class FaceAudit : public testing::TestWithParam<SmallSpecimen> {
 protected:
  static SceneSpec spec() {
    SceneSpec spec = scenes::spec_of(GetParam(), 8, 6);
    spec.elements_per_wall = 2;
    spec.loading.end_strain = 0.6;
    return spec;
  }
};

/// The particle at which the foot of a ball on a segment's round end lies; -1 when it lies between the ends.
int end_below(const Scene& scene, const State& state, const scenes::Overlap& overlap) {
  const Element& element = scene.elements[overlap.segment];
  const double along = (state.position[overlap.ball] - state.position[element.start]).dot(state.axis[overlap.segment]);
  return along <= 0.0 ? element.start : along >= state.length[overlap.segment] ? element.end : -1;
}

/// Whether another segment at the particle, no thinner, shares a face with the ball, or is the ball's own: then its
/// round end gives the same touch.
bool has_same_end(const Scene& scene, const scenes::FaceNeighbours& neighbours, int particle, int ball,
                  double thickness) {
  const auto first = scene.incidence.begin() + scene.incidence_offset[particle];
  const auto last = scene.incidence.begin() + scene.incidence_offset[particle + 1];
  return std::any_of(first, last, [&](int segment) {
    const Element& element = scene.elements[segment];
    return element.start == ball || element.end == ball ||
           (element.thickness >= thickness && neighbours.share_a_face(ball, segment));
  });
}

// Of the overlaps that share no face, those on a round end are found by a segment beside it that ends at the same
// particle. What is left reaches through a wall, no deeper than any contact may, lies above another segment of its
// polyline, and does not push.
TEST_P(FaceAudit, FindsEveryTouchThatPushesWithTheForceOfTheBuckets) {
  const auto scene = scenes::build(spec());
  const scenes::FaceNeighbours neighbours(*scene);
  Simulation simulation(scene);
  std::int64_t all = 0;
  std::int64_t through_a_wall = 0;
  double deepest = 0.0;     // of those, over the wall's thickness
  double difference = 0.0;  // of the forces, over k h
  const std::int64_t interval = std::max<std::int64_t>(1, scene->schedule.step_count / 300);
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(interval);
    State state = simulation.state();
    const scenes::Pairs listed = scenes::listed_pairs(state);
    for (const scenes::Overlap& overlap : scenes::overlaps_by_buckets(*scene, state)) {
      ++all;
      if (overlap.depth < 1e-9 || listed.count({overlap.ball, overlap.segment}) == 1) {
        continue;
      }
      ASSERT_FALSE(neighbours.share_a_face(overlap.ball, overlap.segment)) << "in step " << state.step;
      const int end = end_below(*scene, state, overlap);
      const double thickness = scene->elements[overlap.segment].thickness;
      if (end < 0 || !has_same_end(*scene, neighbours, end, overlap.ball, thickness)) {
        ++through_a_wall;
        deepest = std::max(deepest, overlap.depth / thickness);
      }
    }
    clear_contact_forces(state, 0, static_cast<int>(scene->particle_count()));
    State reference = state;
    list_by_buckets(*scene, reference, reference.contacts.front());
    ContactWorkspace workspace;
    Workers workers(1);
    scenes::evaluate_wall_contacts(*scene, state, workspace, workers);
    scenes::evaluate_wall_contacts(*scene, reference, workspace, workers);
    const double scale = scene->contact.stiffness * scene->elements.front().thickness;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      const ContactForce& here = state.contact_force[i];
      const ContactForce& there = reference.contact_force[i];
      difference = std::max(
          {difference, (here.elastic - there.elastic).norm() / scale, (here.viscous - there.viscous).norm() / scale});
    }
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished);
  EXPECT_LT(simulation.state().crossing_step, 0);
  EXPECT_GT(all, 1500);
  scenes::record_bound("force difference over k h", difference);
  // They come in fours, at a joint that stays pressed flat: with the friction of the test or near it, to 1.1 %.
  EXPECT_LE(through_a_wall, all / 50);
  EXPECT_LT(deepest, 0.25);
  EXPECT_LE(difference, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Crush, FaceAudit,
                         testing::Values(SmallSpecimen{"hexagon", 25, 0.3}, SmallSpecimen{"hexagon", 100, 0.0},
                                         SmallSpecimen{"hexagon", 100, 0.3}, SmallSpecimen{"thick", 100, 0.0},
                                         SmallSpecimen{"thick_ends", 25, 0.0}, SmallSpecimen{"thick_ends", 100, 0.3},
                                         SmallSpecimen{"square", 25, 0.3}, SmallSpecimen{"square", 100, 0.3},
                                         SmallSpecimen{"triangle", 25, 0.3}, SmallSpecimen{"triangle", 100, 0.0},
                                         SmallSpecimen{"triangle", 100, 0.3}),
                         kNames);

}  // namespace
}  // namespace cellcrush
