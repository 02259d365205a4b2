// The same bits, whatever the threads, the samples and the checkpoints.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "cellcrush/tuning.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

/// A specimen whose walls touch within the steps that are run.
SceneSpec specimen() {
  SceneSpec spec = scenes::hexagon_specimen(12, 5);
  spec.imperfection = {0.01, 1};
  return spec;
}

SceneSpec with_friction_and_damping(SceneSpec spec) {
  spec.contact.friction = spec.plates.friction = 0.2;
  spec.numerics.mass_damping_per_s = 1000.0;
  return spec;
}

/// Joints inside a rigid body have no walls.
SceneSpec with_a_rigid_row(SceneSpec spec) {
  spec.inclusions.rows = {2};
  return spec;
}

/// Hash of the state after a crush that has closed some cells.
std::uint64_t hash_after_crush(const SceneSpec& spec, int threads) {
  Simulation simulation(scenes::build(spec), threads);
  simulation.advance(1000);
  EXPECT_GT(simulation.state().contact_totals.count, 0);
  return scenes::hash_of(simulation.state());
}

TEST(Threads, AnyNumberOfThemGivesTheSameBits) {
  for (const SceneSpec& spec : {specimen(), scenes::with_the_papers_elements(specimen()),
                                with_friction_and_damping(specimen()), with_a_rigid_row(specimen())}) {
    const std::uint64_t one = hash_after_crush(spec, 1);
    for (const int threads : {2, 3, 7}) {
      EXPECT_EQ(hash_after_crush(spec, threads), one) << threads;
    }
  }
}

// Where the contacts do not overlap with the walls. Threads share what a sample looks at, too.
TEST(Threads, AnyNumberOfThemGivesTheSameBitsOfALargeLattice) {
  const auto scene = scenes::build(scenes::with_the_papers_elements(scenes::hexagon_specimen(100, 40)));
  ASSERT_GT(scene->element_count(), kMostElementsOverlapped);
  const auto crush_some = [&scene](int threads) {
    Simulation simulation(scene, threads);
    simulation.advance(100);
    const Sample sample = simulation.take_sample();
    return std::tuple(scenes::hash_of(simulation.state()), sample.energies.kinetic, sample.energies.elastic,
                      sample.energies.residual, sample.largest_fibre_strain, sample.most_strained_wall);
  };
  const auto one = crush_some(1);
  EXPECT_GT(std::get<4>(one), 0.0);
  EXPECT_EQ(crush_some(2), one);
  EXPECT_EQ(crush_some(3), one);
}

TEST(Threads, AnyNumberOfThemGivesTheSameBitsOnTheScalarTarget) {
  ASSERT_TRUE(use_simd_target("scalar"));
  const SceneSpec spec = with_friction_and_damping(specimen());
  EXPECT_EQ(hash_after_crush(spec, 3), hash_after_crush(spec, 1));
  EXPECT_TRUE(use_simd_target(""));
}

TEST(Simd, AnUnknownTargetIsRefusedAndChangesNothing) {
  const std::string before = simd_target();
  EXPECT_FALSE(use_simd_target("abacus"));
  EXPECT_EQ(simd_target(), before);
  EXPECT_EQ(simd_targets().back(), "scalar");
}

State crush_in(int chunk) {
  Simulation simulation(scenes::build(scenes::hexagon_specimen(8, 5)));
  for (int done = 0; done < 1500; done += chunk) {
    simulation.advance(chunk);
    simulation.take_sample();
    simulation.take_frame(0);
  }
  return simulation.state();
}

TEST(Determinism, SamplingAndChunksDoNotChangeABit) {
  EXPECT_EQ(scenes::hash_of(crush_in(1500)), scenes::hash_of(crush_in(150)));
}

TEST(Determinism, HashSeesTheLastBitOfEveryField) {
  State state = crush_in(1500);
  const std::uint64_t before = scenes::hash_of(state);
  int index = -1;
  std::set<int> unseen;
  visit_fields(state, [&](auto& field) {
    ++index;
    auto* bytes = [&] {
      if constexpr (requires { field.begin(); }) {
        return reinterpret_cast<unsigned char*>(field.data());
      } else {
        return reinterpret_cast<unsigned char*>(&field);
      }
    }();
    if (bytes == nullptr) return;  // an empty list has no bits
    bytes[0] ^= 1U;
    if (scenes::hash_of(state) == before) unseen.insert(index);
    bytes[0] ^= 1U;
  });
  EXPECT_TRUE(unseen.empty()) << *unseen.begin();
}

struct Trace {
  std::uint64_t hash = 0;
  std::vector<double> stress;
  std::vector<double> collapsed;
  std::vector<CrushMode> modes;
  double last_good_time = 0.0;

  bool operator==(const Trace&) const = default;
};

/// Crushes in 30 pieces; at those of `left_at` the run is left, and another object goes on from its checkpoint.
Trace crush_and_leave(const SceneSpec& spec, const std::set<int>& left_at) {
  auto simulation = std::make_unique<Simulation>(scenes::build(spec));
  Trace out;
  for (int piece = 0; piece < 30; ++piece) {
    if (left_at.contains(piece)) {
      const std::string checkpoint = scenes::checkpoint_of(*simulation);
      simulation = std::make_unique<Simulation>(scenes::build(spec), 2);
      EXPECT_TRUE(simulation->restore(source_of(checkpoint)));
    }
    simulation->advance(100);
    const Sample sample = simulation->take_sample();
    out.stress.push_back(sample.stress_support);
    out.collapsed.push_back(sample.collapsed_fraction);
    out.modes.push_back(sample.crush_mode);
  }
  out.hash = scenes::hash_of(simulation->state());
  out.last_good_time = simulation->last_good_frame().time;
  return out;
}

TEST(Checkpoint, AResumedCrushHasTheSameBits) {
  SceneSpec rubbing = scenes::hexagon_specimen(8, 5);
  rubbing.contact.friction = 0.3;
  rubbing.material.hardening_modulus_mpa = 500.0;
  rubbing.material.isotropic_fraction = 0.5;
  for (const SceneSpec& spec : {scenes::hexagon_specimen(8, 5), rubbing}) {
    EXPECT_TRUE(crush_and_leave(spec, {1, 7, 29}) == crush_and_leave(spec, {}));
  }
}

TEST(Checkpoint, BytesThatAreNoneOfTheSceneLeaveTheRunAtItsStart) {
  Simulation simulation(scenes::build(scenes::hexagon_specimen(8, 5)));
  const std::string start = scenes::checkpoint_of(simulation);
  simulation.advance(200);
  const std::string checkpoint = scenes::checkpoint_of(simulation);
  Simulation larger(scenes::build(scenes::hexagon_specimen(9, 5)));
  EXPECT_FALSE(simulation.restore(source_of(scenes::checkpoint_of(larger))));
  EXPECT_FALSE(simulation.restore(source_of("")));
  EXPECT_FALSE(simulation.restore(source_of(checkpoint + "x")));
  for (std::size_t size = 0; size < checkpoint.size(); size += 997)
    EXPECT_FALSE(simulation.restore(source_of(checkpoint.substr(0, size)))) << size;
  EXPECT_TRUE(scenes::checkpoint_of(simulation) == start);
  simulation.advance(200);
  EXPECT_TRUE(scenes::checkpoint_of(simulation) == checkpoint);
}

TEST(Checkpoint, SamplesComeBackAsTheyWere) {
  std::vector<Sample> samples(2);
  samples[0].time = 0.1;
  samples[0].densest_layer = {0.93, 12.5};
  samples[0].crush_mode = CrushMode::v;
  samples[0].watched.push_back({1.0, 2.0, 3.0});
  samples[1].front = Front{.position = 7.0, .wall_fraction_behind = 0.5};
  samples[1].warnings.push_back({Warning::Kind::denser_than_solid, 12, 0.3, "what", "remedy"});
  const std::string bytes = bytes_of(samples);
  const auto back = samples_of(bytes);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 2U);
  EXPECT_EQ(back->at(0).time, 0.1);
  EXPECT_EQ(back->at(0).densest_layer.solid_fraction, 0.93);
  EXPECT_EQ(back->at(0).densest_layer.place, 12.5);
  EXPECT_EQ(back->at(0).crush_mode, CrushMode::v);
  EXPECT_EQ(back->at(0).watched.at(0).rotation, 3.0);
  EXPECT_FALSE(back->at(0).front);
  EXPECT_EQ(back->at(1).front.value_or(Front{}).wall_fraction_behind, 0.5);
  EXPECT_EQ(back->at(1).warnings.at(0).remedy, "remedy");
  EXPECT_EQ(bytes_of(*back), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(samples_of(bytes.substr(0, size))) << size;
}

}  // namespace
}  // namespace cellcrush
