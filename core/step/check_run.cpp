#include "step/check_run.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "geometry/all_finite.h"
#include "measure/warnings.h"
#include "scene/check_spec.h"

namespace cellcrush {
namespace {

constexpr const char* kShorterStep = "Use a shorter numerics.time_step_s, or 0 for an automatic step.";
constexpr const char* kStifferContact =
    "Use a shorter numerics.time_step_s, or 0 for an automatic step, or a larger contact.stiffness_factor.";

bool is_finite(const State& state, std::size_t particle) {
  return state.position[particle].allFinite() && state.velocity[particle].allFinite() &&
         std::isfinite(state.spin[particle]);
}

bool has_finite_forces(const State& state, std::size_t particle) {
  return state.internal_force[particle].allFinite() && std::isfinite(state.internal_moment[particle]) &&
         state.contact_force[particle].elastic.allFinite() && state.contact_force[particle].viscous.allFinite();
}

/// The first particle with a non-finite value, if any.
template <class Predicate>
std::optional<std::size_t> find_lost(const Scene& scene, Predicate&& is_kept) {
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    if (!is_kept(i)) {
      return i;
    }
  }
  return std::nullopt;
}

/// Names the fastest particle: the place where too long a step shows first.
std::string fastest_place(const Scene& scene, const State& state) {
  const auto slower = [](const Vector2& a, const Vector2& b) { return a.squaredNorm() < b.squaredNorm(); };
  const auto fastest = std::max_element(state.velocity.begin(), state.velocity.end(), slower);
  return "; the fastest particle is " + place_of(scene, static_cast<std::size_t>(fastest - state.velocity.begin())) +
         ", at " + to_text(std::round(fastest->norm() / 100.0) / 10.0) + " m/s";
}

RunStatus diverged(const State& state, const std::string& what) {
  return {RunStatus::Kind::diverged, what + " is not finite at " + moment_of(state.step, state.time) + ".",
          kShorterStep};
}

RunStatus check_rotation(const Scene& scene, const State& state) {
  Eigen::Index most = 0;
  const Eigen::Map<const Eigen::ArrayXd> spins(state.spin.data(), static_cast<Eigen::Index>(state.spin.size()));
  if (spins.abs().maxCoeff() * scene.schedule.time_step <= kLargestRotation) {
    return {};
  }
  const double rotation = spins.abs().maxCoeff(&most) * scene.schedule.time_step;
  return {RunStatus::Kind::large_rotation,
          "One step rotates " + place_of(scene, static_cast<std::size_t>(most)) + " by " +
              to_text(std::round(100.0 * rotation) / 100.0) + " rad, more than the largest allowed increment of " +
              to_text(kLargestRotation) + " rad, at " + moment_of(state.step, state.time) + ".",
          kShorterStep};
}

RunStatus check_energy(const Scene& scene, const State& state, const Sample& sample) {
  if (!std::isfinite(sample.energy_residual)) {
    const auto lost = find_lost(scene, [&](std::size_t i) { return has_finite_forces(state, i); });
    return diverged(state, lost ? "The force on " + place_of(scene, *lost) + "," : "The energy");
  }
  const double turnover = turnover_of(sample);
  if (turnover <= 0.0) {
    return {};
  }
  if (std::abs(sample.energy_residual) > kLargestEnergyError * turnover) {
    return {RunStatus::Kind::energy_balance,
            "The energy balance has an error of " + percent_of(sample.energy_residual / turnover) +
                " of the work done at " + moment_of(state.step, state.time) + ": the time integration is unstable" +
                fastest_place(scene, state) + ".",
            "Use a shorter numerics.time_step_s: crushed walls are shorter than the undeformed walls that determine "
            "the stable step."};
  }
  if (-sample.energy_contact > kLargestEnergyError * turnover) {
    return {RunStatus::Kind::contact_energy,
            "Contacts have created energy of " + percent_of(-sample.energy_contact / turnover) +
                " of the work done by " + moment_of(state.step, state.time) + ": walls already overlapped by " +
                percent_of(state.contact_totals.deepest_birth) + " of their thickness when their contact was found" +
                fastest_place(scene, state) + ".",
            "Use a shorter numerics.time_step_s, or 0 for an automatic step: the plate should move by at most one "
            "twentieth of the thinnest wall's thickness per step."};
  }
  return {};
}

RunStatus check_walls(const Scene& scene, const State& state, const Sample& sample) {
  if (state.crossing_step >= 0) {
    const double time = static_cast<double>(state.crossing_step) * scene.schedule.time_step;
    return {RunStatus::Kind::wall_crossing,
            "A wall had passed through another at " + moment_of(state.crossing_step, time) +
                deepest_place(scene, state) + ".",
            scene.plates.present ? kShorterStep : kStifferContact};
  }
  if (sample.densest_layer.solid_fraction > kMostCompaction) {
    return {RunStatus::Kind::overcompaction,
            words_of(sample.densest_layer) + " at " + moment_of(state.step, state.time) + ", strain " +
                to_text(std::round(1e3 * sample.strain) / 1e3) +
                ". Walls overlap there by more than contacts can bear: the forces are no longer those of metal.",
            "Give a smaller loading.end_strain. The samples before are kept; from a solid fraction of 1 on, take their "
            "stresses as a lower bound."};
  }
  return {};
}

}  // namespace

RunStatus check_run(const Scene& scene, const State& state, const Sample& sample) {
  if (!(all_finite(state.position) && all_finite(state.velocity) && all_finite(state.spin))) {
    if (const auto lost = find_lost(scene, [&](std::size_t i) { return is_finite(state, i); })) {
      return diverged(state, "The motion of " + place_of(scene, *lost) + ",");
    }
  }
  RunStatus status = check_rotation(scene, state);
  if (status.kind == RunStatus::Kind::running) {
    status = check_energy(scene, state, sample);
  }
  return status.kind == RunStatus::Kind::running ? check_walls(scene, state, sample) : status;
}

}  // namespace cellcrush
