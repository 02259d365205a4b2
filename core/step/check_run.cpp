#include "step/check_run.h"

#include <algorithm>
#include <cmath>

#include "scene/check_spec.h"

namespace cellcrush {
namespace {

std::string moment_of(const State& state) {
  return "at step " + std::to_string(state.step) + ", t = " + to_text(state.time) + " s";
}

}  // namespace

RunStatus check_run(const Scene& scene, const State& state, const Sample& sample) {
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    if (!state.position[i].allFinite() || !state.velocity[i].allFinite() || !std::isfinite(state.spin[i])) {
      return {RunStatus::Kind::diverged,
              "The motion of particle " + std::to_string(i) + ", at (" + to_text(scene.position[i].x()) + ", " +
                  to_text(scene.position[i].y()) + ") mm before loading, is not finite " + moment_of(state) + ".",
              "Give a shorter numerics.time_step_s, or 0 to have it chosen."};
    }
  }
  const double turnover = std::max(std::abs(sample.work_external), sample.energy_kinetic + state.ledger.initial);
  if (turnover > 0.0 && !(std::abs(sample.energy_residual) <= kLargestEnergyError * turnover)) {
    return {RunStatus::Kind::energy_balance,
            "The energy ledger is open by " + to_text(std::round(1000.0 * sample.energy_residual / turnover) / 10.0) +
                " % of the work done " + moment_of(state) + ": the time integration is not stable.",
            "Give a shorter numerics.time_step_s; crushed walls are shorter than those the stable step is taken from."};
  }
  return {};
}

}  // namespace cellcrush
