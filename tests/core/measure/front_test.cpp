#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measure/crush_mode.h"
#include "measure/layers.h"
#include "measure/theory.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/near_pairs.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

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
    EXPECT_NEAR(front->strain_behind, kBehind, 1e-9) << share;
    EXPECT_NEAR(front->strain_ahead, kAhead, 1e-9) << share;
    scenes::record_bound("strains",
                         std::max(std::abs(front->strain_behind - kBehind), std::abs(front->strain_ahead - kAhead)));
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
  for (Vector2& velocity : slow.velocity) {
    velocity *= 0.7;
  }
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
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % 2 == 0) {
      samples[i].front.reset();
    }
  }
  EXPECT_FALSE(summarize_front(*scene_, samples, 0.5)) << "two thirds of the window have none";
}

}  // namespace
}  // namespace cellcrush
