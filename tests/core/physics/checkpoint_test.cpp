#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

constexpr int kSteps = 3000;
constexpr int kPiece = 100;

struct Trace {
  std::uint64_t hash = 0;
  std::vector<double> stress;
  std::vector<double> collapsed;
  std::vector<int> modes;
  double last_good_time = 0.0;
};

// Crushes in pieces; at the piece `left_at` the run is left, and another object goes on from its checkpoint.
Trace crush(const SceneSpec& spec, int left_at) {
  auto simulation = std::make_unique<Simulation>(scenes::build(spec));
  Trace out;
  for (int piece = 0; piece < kSteps / kPiece; ++piece) {
    if (piece == left_at) {
      const std::string checkpoint = simulation->checkpoint();
      simulation = std::make_unique<Simulation>(scenes::build(spec), 2);
      EXPECT_TRUE(simulation->restore(checkpoint));
    }
    simulation->advance(kPiece);
    const Sample sample = simulation->take_sample();
    out.stress.push_back(sample.stress_support);
    out.collapsed.push_back(sample.collapsed_fraction);
    out.modes.push_back(static_cast<int>(sample.crush_mode));
  }
  out.hash = scenes::hash_of(simulation->state());
  out.last_good_time = simulation->last_good_frame().time;
  return out;
}

void expect_same_bits(const SceneSpec& spec) {
  const Trace whole = crush(spec, -1);
  for (const int left_at : {1, 7, 29}) {
    const Trace resumed = crush(spec, left_at);
    EXPECT_EQ(resumed.hash, whole.hash) << "left at piece " << left_at;
    EXPECT_EQ(resumed.stress, whole.stress);
    EXPECT_EQ(resumed.collapsed, whole.collapsed);
    EXPECT_EQ(resumed.modes, whole.modes);
    EXPECT_EQ(resumed.last_good_time, whole.last_good_time);
  }
}

TEST(Checkpoint, AResumedCrushHasTheSameBits) { expect_same_bits(scenes::hexagon_specimen(8, 5)); }

TEST(Checkpoint, AResumedCrushWithFrictionAndHardeningHasTheSameBits) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.contact.friction = 0.3;
  spec.material.hardening_modulus_mpa = 500.0;
  spec.material.isotropic_fraction = 0.5;
  expect_same_bits(spec);
}

TEST(Checkpoint, BytesThatAreNoneOfTheSceneChangeNothing) {
  Simulation simulation(scenes::build(scenes::hexagon_specimen(8, 5)));
  simulation.advance(200);
  const std::uint64_t before = scenes::hash_of(simulation.state());
  const std::string checkpoint = simulation.checkpoint();
  Simulation larger(scenes::build(scenes::hexagon_specimen(9, 5)));
  EXPECT_FALSE(simulation.restore(larger.checkpoint()));
  EXPECT_FALSE(simulation.restore(""));
  EXPECT_FALSE(simulation.restore(checkpoint + "x"));
  for (std::size_t size = 0; size < checkpoint.size(); size += 997)
    EXPECT_FALSE(simulation.restore(checkpoint.substr(0, size))) << size;
  EXPECT_EQ(scenes::hash_of(simulation.state()), before);
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
