#include "measure/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/crush_mode.h"
#include "measure/theory.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "scenes/presets.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// A lattice of one of the presets whose particles are moved along the crush at will.
struct Moved {
  std::shared_ptr<Scene> scene;
  double pitch;
  State state;

  template <class PlaceOf>
  Moved(const char* preset, const PlaceOf& place_of)
      : scene(scenes::build(scenes::preset(preset))),
        pitch(find_cells(*scene).field.pitch),
        state(make_initial_state(*scene)) {
    const int axis = scene->plates.axis;
    for (Vector2& position : state.position) {
      position[axis] = place_of(position[axis]);
    }
    scenes::follow_positions(*scene, state);
  }

  [[nodiscard]] DensestLayer find() const { return find_densest_layer(*scene, state, size_of_layers(*scene, pitch)); }

  /// Length times thickness of the walls now, mm^2.
  [[nodiscard]] double metal() const {
    double sum = 0.0;
    for (std::size_t e = 0; e < scene->element_count(); ++e) {
      sum += state.length[e] * scene->elements[e].thickness;
    }
    return sum;
  }
};

// Pressed evenly together, all layers are alike but for the cells that they cut, the more so the more cells fit in one.
TEST(DensestLayer, OfAnEvenlyCompactedLatticeHasItsSolidFraction) {
  for (const char* preset : {"hexagon-small", "type-i", "type-ii-as-counted", "type-iii-as-counted"}) {
    constexpr double kLeft = 0.05;
    const Moved crushed(preset, [](double place) { return kLeft * place; });
    const double even = crushed.metal() / (kLeft * crushed.scene->length * crushed.scene->width);
    EXPECT_GT(even, 1.0) << preset;
    scenes::record_bound("evenly compacted in %", 100.0 * std::abs(crushed.find().solid_fraction / even - 1.0), 5.0);
  }
}

TEST(DensestLayer, IsFoundWhereTheLatticeIsCompacted) {
  for (const double middle : {0.2, 0.5, 0.8}) {
    // A tenth of the length is pressed together to a twelfth.
    const auto squeeze = [&](double place) {
      const double length = 20.0 * 4.0 * std::sqrt(3.0);
      const double from = (middle - 0.05) * length;
      const double inside = std::clamp(place - from, 0.0, 0.1 * length);
      return place - (1.0 - 1.0 / 12.0) * inside;
    };
    const Moved crushed("hexagon-small", squeeze);
    const DensestLayer layer = crushed.find();
    EXPECT_GT(layer.solid_fraction, 3.0 * relative_density_of(*crushed.scene));
    EXPECT_NEAR(layer.place / crushed.scene->length, middle, 0.06);
  }
}

// Layers of thin foil are far thinner than a cell, and may have a single joint in them.
TEST(DensestLayer, OfThinFoilIsNotADisplacedJoint) {
  SceneSpec spec = scenes::hexagon_specimen(9, 12);
  RegularLattice& lattice = scenes::cells_of(spec);
  lattice.side_mm = 2.75;
  lattice.wall_thickness_mm = 0.0254;
  lattice.own["vertical_wall_thickness_mm"] = 0.0508;
  spec.elements_per_wall = 2;
  spec.imperfection = {0.05, 1};
  const auto scene = scenes::build(spec);
  State state = make_initial_state(*scene);
  state.position[scene->joint_count / 2].x() += 0.6;
  scenes::follow_positions(*scene, state);
  const LayerSize size = size_of_layers(*scene, find_cells(*scene).field.pitch);
  EXPECT_GT(find_densest_layer(*scene, state, {size.depth, 0.0}).solid_fraction, 1.0) << "a joint on its own";
  EXPECT_LT(find_densest_layer(*scene, state, size).solid_fraction, 20.0 * relative_density_of(*scene));
}

TEST(DensestLayer, OfWallsThatHaveGrownIsDenser) {
  Moved crushed("hexagon-small", [](double place) { return 0.1 * place; });
  const double before = crushed.find().solid_fraction;
  for (std::size_t e = 0; e < crushed.scene->element_count(); ++e) {
    crushed.state.thickening[e] = 0.1 * crushed.scene->elements[e].thickness;
  }
  EXPECT_NEAR(crushed.find().solid_fraction, 1.2 * before, 0.01 * before);
}

constexpr double kBehind = 0.88;
constexpr double kAhead = 0.02;
constexpr double kSpeed = 1e5;  // mm/s

/// A specimen whose particles move as a front at `place` (mm from the impact end) moves them: strain kBehind behind it,
/// kAhead ahead of it, the support end at rest. What is behind moves with the plate, at kSpeed.
class MovingFront : public testing::Test {
 protected:
  std::shared_ptr<Scene> scene_ = scenes::build(scenes::hexagon_specimen(40, 9));
  Cells cells_ = find_cells(*scene_);
  Columns columns_ = divide_into_columns(*scene_, cells_.field.pitch);
  double length_ = cells_.field.length;

  [[nodiscard]] State moved(double place) const {
    State state = make_initial_state(*scene_);
    for (std::size_t i = 0; i < scene_->particle_count(); ++i) {
      const double x = scene_->position[i].x();
      const double behind = std::max(0.0, place - x);
      const double ahead = length_ - std::max(place, x);
      state.position[i].x() += kBehind * behind + kAhead * ahead;
      state.velocity[i].x() = x < place ? kSpeed : 0.0;
    }
    return state;
  }

  [[nodiscard]] std::optional<Front> find(State state) const {
    scenes::follow_positions(*scene_, state);
    return find_front(columns_, *scene_, state);
  }
};

TEST_F(MovingFront, IsFoundWithItsStrainsVelocitiesAndPlace) {
  for (const double share : {0.2, 0.333, 0.5, 0.71}) {
    const auto front = find(moved(share * length_));
    ASSERT_TRUE(front) << share;
    scenes::record_bound(
        "strains", std::max(std::abs(front->strain_behind - kBehind), std::abs(front->strain_ahead - kAhead)), 1e-9);
    EXPECT_NEAR(front->velocity_behind, kSpeed, 1e-6) << share;
    EXPECT_NEAR(front->velocity_ahead, 0.0, 1e-6) << share;
    EXPECT_NEAR(front->position, share * length_, 1e-6) << share;
  }
}

TEST_F(MovingFront, SolidFractionIsByMassAndByTheWallsOfNow) {
  State state = moved(0.5 * length_);
  const auto front = find(state);
  ASSERT_TRUE(front);
  EXPECT_NEAR(front->solid_fraction_behind, relative_density_of(*scene_) / (1.0 - kBehind), 1e-9);
  // Squeezed affinely along x: a wall along y keeps its length, a slanted one, 30 degrees off x, keeps half at least.
  const double slanted = std::hypot(std::sqrt(0.75) * (1.0 - kBehind), 0.5);
  const double ratio = front->wall_fraction_behind / front->solid_fraction_behind;
  EXPECT_NEAR(ratio, (1.0 + 2.0 * slanted) / 3.0, 0.02);
}

TEST_F(MovingFront, IsNotSeenBeforeItHasLeftTheEndNorInAUniformCrush) {
  EXPECT_FALSE(find(moved(2.0 * cells_.field.pitch)));
  EXPECT_FALSE(find(moved(length_ - 2.0 * cells_.field.pitch)));
  State state = moved(0.0);
  for (std::size_t i = 0; i < scene_->particle_count(); ++i) {
    const double x = scene_->position[i].x();
    state.position[i].x() = x + 0.4 * (length_ - x);
    state.velocity[i].x() = kSpeed * (1.0 - x / length_);
  }
  EXPECT_FALSE(find(state));
}

TEST_F(MovingFront, IsNotSeenWhereTheStrainRampsOrTheMaterialBehindLagsThePlate) {
  State ramp = moved(0.5 * length_);
  for (std::size_t i = 0; i < scene_->particle_count(); ++i) {
    const double x = scene_->position[i].x();
    ramp.position[i].x() = x + 0.8 * (length_ - x) * (length_ - x) / (2.0 * length_);
  }
  EXPECT_FALSE(find(ramp));
  State slow = moved(0.5 * length_);
  for (Vector2& velocity : slow.velocity) velocity *= 0.7;
  EXPECT_FALSE(find(slow));
}

TEST_F(MovingFront, Equation52TakesItsJumpsFromTheMotion) {
  std::vector<Sample> samples;
  // The material ahead is braked at a constant rate.
  constexpr double kBraking = -2e6;  // mm/s^2
  for (int i = 1; i <= 100; ++i) {
    Sample sample;
    sample.time = 1e-5 * i;
    sample.strain = 0.006 * i;
    if (i % 3 != 0) {
      sample.front = Front{};
      sample.front->position = 0.4 * length_;
      sample.front->strain_behind = 0.9;
      sample.front->strain_ahead = 0.1;
      sample.front->velocity_behind = kSpeed;
      sample.front->velocity_ahead = 5e3 + kBraking * (sample.time - 5e-4);
    }
    samples.push_back(sample);
  }
  const auto front = summarize_front(*scene_, samples, 0.5);
  ASSERT_TRUE(front);
  EXPECT_NEAR(front->window_share, 2.0 / 3.0, 0.03);
  const double density = scene_->total_mass / (scene_->length * scene_->width * scene_->depth);
  const double ahead = 0.5 + density * (scene_->length - 0.4 * length_) * kBraking;
  EXPECT_NEAR(front->stress_ahead, ahead, 1e-9);
  const double jump = kSpeed - front->velocity_ahead;
  EXPECT_NEAR(front->shock, ahead + density * jump * jump / 0.8, 1e-9);
  for (std::size_t i = 0; i < samples.size(); i += 2) samples[i].front.reset();
  EXPECT_FALSE(summarize_front(*scene_, samples, 0.5)) << "two thirds of the window have none";
}

}  // namespace
}  // namespace cellcrush
