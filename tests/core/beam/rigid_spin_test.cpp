#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "beam/internal_forces.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/topology/bands.h"
#include "motion/initial_state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

// The motion is imposed, so nothing but the reverse motion can make stress.
TEST(RigidSpin, ThousandTurnsLeaveStressAtRoundOff) {
  SceneSpec spec = scenes::hexagon_specimen(3, 2);
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  const auto scene = scenes::build(spec);
  ASSERT_TRUE(scene);
  State state = place_particles(*scene);
  Workers workers(1);
  WallsWorkspace walls;
  std::vector<double> plastic_work(static_cast<std::size_t>(scene->walls.chunk_count()));
  constexpr int kStepsPerTurn = 400;
  constexpr int kTurns = 1000;
  const double turn = 2.0 * std::numbers::pi / kStepsPerTurn;
  const Vector2 centre(5.0, 5.0);
  std::fill(state.spin.begin(), state.spin.end(), turn / scene->schedule.time_step);
  for (int step = 1; step <= kStepsPerTurn * kTurns; ++step) {
    const double angle = turn * (step % kStepsPerTurn);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (std::size_t i = 0; i < scene->particle_count(); ++i) {
      const Vector2 arm = scene->position[i] - centre;
      state.position[i] = centre + Vector2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
    }
    state.step = step;
    evaluate_internal_forces(*scene, state, whole_band(*scene), walls, workers, plastic_work.data());
  }
  ASSERT_FALSE(state.fibres.stress.empty());
  double greatest = 0.0;
  for (const double stress : state.fibres.stress) {
    greatest = std::max(greatest, std::abs(stress));
  }
  scenes::record_bound("stress over yield stress", greatest / scene->materials.front().yield_stress);
  EXPECT_LT(greatest, 1e-6 * scene->materials.front().yield_stress);
}

}  // namespace
}  // namespace cellcrush
