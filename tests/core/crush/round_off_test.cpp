// Round-off stays round-off: no threshold of the elements makes it visible before buckling and contact do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

Vector2 turned(const Vector2& vector, double angle) {
  return vector.x() * scenes::direction(angle) + vector.y() * normal_of(scenes::direction(angle));
}

/// A block of hexagons turned by an angle: its joints at one end move toward those at the other, which are held. Its
/// particles are off their places by up to `offset` mm. `seed` is that of its imperfection.
std::shared_ptr<Scene> turned_block(double angle, double speed, double strain, double offset = 0.0,
                                    std::uint64_t seed = 1) {
  SceneSpec spec = scenes::in_double_precision(scenes::hexagon_specimen(6, 4));
  spec.imperfection = {0.02, seed};
  const auto scene = scenes::build(spec);
  const double end_time = strain * scene->length / speed;
  scene->plates.present = false;
  scene->schedule.step_count = static_cast<std::int64_t>(end_time / scene->schedule.time_step);
  scene->supports.assign(scene->particle_count(), {});
  const Vector2 travel = turned({strain * scene->length, 0.0}, angle);
  scene->motions = {{{{0.0, 0.0}, {end_time, travel.x()}}}, {{{0.0, 0.0}, {end_time, travel.y()}}}};
  for (int joint = 0; joint < scene->joint_count; ++joint) {
    const double x = scene->position[joint].x();
    if (x < 1.0) {
      scene->supports[joint] = {{true, 0}, {true, 1}, {true, -1}};
    } else if (x > scene->length - 1.0) {
      scene->supports[joint] = {{true, -1}, {true, -1}, {true, -1}};
    }
  }
  std::mt19937_64 generator(1);
  const auto draw = [&] { return offset * (2.0 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1.0); };
  for (Vector2& position : scene->position) {
    const double x = draw();
    position = turned(position + Vector2(x, draw()), angle);
  }
  return scene;
}

/// Greatest distance between the particles of a block and of one that is turned or off its places, turned back, at the
/// end.
double parted_at_end(const std::shared_ptr<Scene>& block, const std::shared_ptr<Scene>& other, double angle) {
  Simulation straight(block);
  Simulation simulation(other);
  const std::int64_t steps = straight.scene().schedule.step_count;
  straight.advance(steps);
  simulation.advance(steps);
  EXPECT_EQ(straight.step(), steps);
  EXPECT_GT(straight.state().contact_totals.count, 10) << "walls must touch";
  EXPECT_GT(straight.state().ledger.plastic, 1.0);
  State back = simulation.state();
  for (Vector2& position : back.position) position = turned(position, -angle);
  return scenes::distance_between(straight.state(), back);
}

constexpr double kTurnOfBlock = 37.0 * std::numbers::pi / 180.0;

TEST(RoundOff, ATurnedBlockIsCrushedLikeAnUpright) {
  for (const auto& [speed, strain] : {std::pair(20e3, 0.6), {20e3, 0.8}, {100e3, 0.6}}) {
    const double distance =
        parted_at_end(turned_block(0.0, speed, strain), turned_block(kTurnOfBlock, speed, strain), kTurnOfBlock);
    scenes::record_bound("distance in mm at " + std::to_string(std::lround(speed / 1e3)) + " m/s and strain " +
                             std::to_string(strain).substr(0, 3),
                         distance, 1e-9);
  }
}

// At 100 m/s and 80 % strain most walls press on others, and round-off grows: places half a unit of the last digit off
// part a block from itself by up to 4e-8 mm, depending on its imperfection. A turned block has its places rounded.
// Turning adds nothing of its own.
TEST(RoundOff, ATurnedBlockCrushedFlatPartsNoFurtherThanARoundedOne) {
  constexpr double kSpeed = 100e3;
  constexpr double kStrain = 0.8;
  constexpr double kHalfOfLastDigit = 0x1p-48;  // mm, of places from 32 to 64 mm
  double rounded = 0.0;
  double of_turning = 0.0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const auto upright = turned_block(0.0, kSpeed, kStrain, 0.0, seed);
    const auto other = turned_block(0.0, kSpeed, kStrain, kHalfOfLastDigit, seed);
    const auto askew = turned_block(kTurnOfBlock, kSpeed, kStrain, 0.0, seed);
    rounded = std::max(rounded, parted_at_end(upright, other, 0.0));
    of_turning = std::max(of_turning, parted_at_end(upright, askew, kTurnOfBlock));
  }
  EXPECT_LT(of_turning, 3.0 * rounded);
  scenes::record_bound("distance in mm of rounded places", rounded);
  scenes::record_bound("distance in mm of turning", of_turning, 1e-7);
}

/// The particle whose place before loading is that of each one, mirrored across the crush.
std::vector<std::size_t> mirror_images(const Scene& scene) {
  const double axis = 0.5 * (std::ranges::max(scene.position, {}, [](const Vector2& p) { return p.y(); }).y() +
                             std::ranges::min(scene.position, {}, [](const Vector2& p) { return p.y(); }).y());
  std::vector<std::size_t> images;
  for (const Vector2& place : scene.position) {
    const Vector2 image(place.x(), 2.0 * axis - place.y());
    const auto found = std::ranges::min_element(scene.position, {},
                                                [&](const Vector2& other) { return (other - image).squaredNorm(); });
    images.push_back(static_cast<std::size_t>(found - scene.position.begin()));
  }
  return images;
}

/// How far the particles of a state are from mirror symmetry, mm.
double asymmetry(const Scene& scene, const State& state, const std::vector<std::size_t>& images) {
  double most = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Vector2 moved = state.position[i] - scene.position[i];
    const Vector2 image = state.position[images[i]] - scene.position[images[i]];
    most = std::max({most, std::abs(moved.x() - image.x()), std::abs(moved.y() + image.y())});
  }
  return most;
}

// With steps above 2e-7 s a ball on the axis comes to touch both halves of a wall across it equally deep at strain
// 0.025, and the touch that counts is one of them.
TEST(RoundOff, APerfectHoneycombStaysSymmetricUntilItBuckles) {
  SceneSpec spec = scenes::in_double_precision(scenes::preset("type-i"));
  spec.imperfection = {};
  spec.numerics.time_step_s = 1.73e-7;
  const auto scene = scenes::build(spec);
  const std::vector<std::size_t> images = mirror_images(*scene);
  Simulation simulation(scene);
  for (const auto& [strain, bound] : {std::pair(0.025, 1e-8), {0.045, 1e-7}}) {
    while (simulation.strain() < strain) {
      simulation.advance(10);
    }
    const double distance = asymmetry(*scene, simulation.state(), images);
    scenes::record_bound("distance in mm at " + std::to_string(strain).substr(0, 5), distance, bound);
  }
}

}  // namespace
}  // namespace cellcrush
