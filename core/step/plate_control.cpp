#include "step/plate_control.h"

#include <algorithm>
#include <cmath>

#include "energy/ledger.h"
#include "push/push.h"

namespace cellcrush {
namespace {

constexpr std::int64_t kSettings = 3000;  // of the planned run
constexpr double kRise = 1.01;            // of the speed, from one setting to the next
constexpr double kFall = 1.0 / 1.08;
constexpr double kLowPart = 0.4;  // of the bound: cells that snap make the energy leap
constexpr double kHighPart = 0.6;
constexpr double kInHaste = 0.5;  // of the greatest speed
constexpr std::int64_t kMostOverPlanned = 4;

/// Least speed that comes to the end in the time left, if that is not far below the greatest one; otherwise 0.
double least_speed_of(const Scene& scene, const State& state) {
  const auto steps = static_cast<double>(most_steps_of(scene) - state.step);
  const double left = scene.plates.end_travel - state.impact_travel;
  const double speed = left / (std::max(steps, 1.0) * scene.schedule.time_step);
  return speed > kInHaste * scene.plates.speed ? speed : 0.0;
}

}  // namespace

bool is_controlled(const Scene& scene) { return scene.plates.kinetic_share > 0.0; }

std::int64_t most_steps_of(const Scene& scene) {
  return (is_controlled(scene) ? kMostOverPlanned : 1) * scene.schedule.step_count;
}

std::int64_t control_interval(const Schedule& schedule) {
  return std::max<std::int64_t>(1, schedule.step_count / kSettings);
}

void control_plate(const Scene& scene, State& state) {
  const Energies energies = evaluate_energies(scene, state);
  const double bound = scene.plates.kinetic_share * std::max(energies.external, 0.0);
  const double step = scene.schedule.time_step;
  const double since = state.time - 0.5 * step;  // of the speed of the newest step
  const double speed = plate_speed_at(scene, state, since);
  double factor = 1.0;
  if (energies.kinetic < kLowPart * bound) {
    factor = kRise;
  } else if (energies.kinetic > kHighPart * bound) {
    factor = kFall;
  }
  const double wanted = std::clamp(factor * speed, kStartOfControl * scene.plates.speed, scene.plates.speed);
  const double next = std::max(wanted, std::min(kRise * speed, least_speed_of(scene, state)));
  const double duration = static_cast<double>(control_interval(scene.schedule)) * step;
  state.plate_drive.front() = {since, speed, (next - speed) / duration};
}

bool has_arrived(const Scene& scene, const State& state) {
  return is_controlled(scene) && state.impact_travel >= scene.plates.end_travel;
}

std::int64_t steps_to_arrival(const Scene& scene, const State& state) {
  const double step = scene.schedule.time_step;
  const PlateDrive& drive = state.plate_drive.front();
  const double duration = static_cast<double>(control_interval(scene.schedule)) * step;
  const double fastest = std::max(drive.speed, drive.speed + drive.rate * (duration + step));
  const double steps = (scene.plates.end_travel - state.impact_travel) / (step * fastest);
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(std::min(steps, 1e15))));
}

}  // namespace cellcrush
