#include "step/check_run.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "contact/repeated_mesh.h"
#include "measure/inertia.h"
#include "measure/warnings.h"
#include "scene/check_spec.h"
#include "scene/solid_area.h"
#include "scene/time_step.h"

namespace cellcrush {
namespace {

constexpr const char* kShorterStep = "Use a shorter numerics.time_step_s, or 0 for an automatic step.";
constexpr const char* kStifferContact =
    "Use a shorter numerics.time_step_s, 0 for an automatic step, or a greater contact.impact_speed_m_per_s.";

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

/// Energy that all walls store when they yield in tension, mJ.
double energy_at_yield(const Scene& scene) {
  const Walls& walls = scene.walls;
  double energy = 0.0;
  for (const WallBlock& block : walls.blocks) {
    for (int w = block.first_wall; w < block.first_wall + block.walls; ++w) {
      const Material& material = scene.materials[walls.material[w]];
      const double volume = block.elements * walls.undeformed_length[w] * walls.thickness[w] * scene.depth;
      energy += 0.5 * material.yield_stress * material.yield_stress / material.youngs_modulus * volume;
    }
  }
  return energy;
}

RunStatus check_energy(const Scene& scene, const State& state, const Sample& sample) {
  if (!std::isfinite(sample.energies.residual)) {
    const auto lost = find_lost(scene, [&](std::size_t i) { return has_finite_forces(state, i); });
    return diverged(state, lost ? "The force on " + place_of(scene, *lost) + "," : "The energy");
  }
  // Nothing acts yet: rounding of lengths alone makes energies.
  constexpr double kRoundOff = 1e-18;
  const double turnover = turnover_of(sample);
  if (turnover <= 0.0 || turnover <= kRoundOff * energy_at_yield(scene)) {
    return {};
  }
  if (std::abs(sample.energies.residual) > kLargestEnergyError * turnover) {
    const bool is_closed = is_past_closing(scene, sample.strain);
    return {RunStatus::Kind::energy_balance,
            "The energy balance has an error of " + percent_of(sample.energies.residual / turnover) +
                " of the work done at " + moment_of(state.step, state.time) +
                (is_closed ? ", at strain " + to_text(std::round(1e3 * sample.strain) / 1e3) +
                                 ", past that at which the lattice is closed"
                           : ": the time integration is unstable") +
                fastest_place(scene, state) + ".",
            is_closed ? "End the run where the lattice is closed: leave out loading.end_strain."
                      : "Use a shorter numerics.time_step_s."};
  }
  if (-sample.energies.contact > kLargestEnergyError * turnover) {
    return {RunStatus::Kind::contact_energy,
            "Contacts have created energy of " + percent_of(-sample.energies.contact / turnover) +
                " of the work done by " + moment_of(state.step, state.time) + ": walls already overlapped by " +
                percent_of(state.contact_totals.deepest_birth) + " of their thickness when their contact was found" +
                fastest_place(scene, state) + ".",
            "Use a shorter numerics.time_step_s, or 0 for an automatic step: the plate should move by at most one "
            "twentieth of the thinnest wall's thickness per step."};
  }
  return {};
}

RunStatus check_inertia(const Scene& scene, const State& state, const Sample& sample) {
  const double share = unwanted_share_of(scene, inertia_share_of(sample));
  if (share <= kLargestInertia || !scene.plates.present || !inertia_window_of(scene).holds(sample.strain)) {
    return {};
  }
  return {RunStatus::Kind::inertia,
          "Inertia bears too much of the load: at " + moment_of(state.step, state.time) + ", strain " +
              to_text(std::round(1e3 * sample.strain) / 1e3) + ", " + words_of_inertia(scene, share) + ".",
          remedy_for_inertia(scene, share)};
}

/// Speed of approach for which the step of a scene would be chosen, mm/s.
double speed_of_step(const Scene& scene) { return kTravelPerStep * scene.contact.thinnest / scene.schedule.time_step; }

/// What makes contacts of a frame safe at a speed of approach, mm/s.
std::string remedy_for_speed(const Scene& scene, double speed) {
  const std::string give = "Give contact.impact_speed_m_per_s as " + to_text(std::ceil(1e-3 * speed - 0.01)) +
                           " or more: contacts and the automatic step then suit that speed.";
  return scene.schedule.bound == StepBound::asked_for ? std::string(kShorterStep) + " " + give : give;
}

RunStatus check_contacts(const Scene& scene, const State& state) {
  if (outgrows_copies(scene, state)) {
    return {
        RunStatus::Kind::contact_lost,
        "Walls have moved so far across the crush, by several periods of the sides against each other, that contacts "
        "with the copies of the lattice could be missed, by " +
            moment_of(state.step, state.time) + ".",
        "Give more columns or, crushed along X, rows."};
  }
  if (state.fastest_step.empty()) {
    return {};
  }
  const FastestStep& fastest = state.fastest_step.front();
  const double step = scene.schedule.time_step;
  const double speed = fastest.travel / step;
  if (fastest.travel > scene.contact.most_travel) {
    return {RunStatus::Kind::contact_lost,
            "Beams can have passed through each other: in one step parts of the frame approached each other by " +
                percent_of(fastest.travel / scene.contact.thinnest) + " of the thinnest beam's thickness, more than " +
                percent_of(scene.contact.most_travel / scene.contact.thinnest) + ", at " +
                moment_of(fastest.step, static_cast<double>(fastest.step) * step) + "; the fastest particle is " +
                place_of(scene, static_cast<std::size_t>(fastest.particle)) + ", and velocities differ by " +
                to_text(std::round(speed / 100.0) / 10.0) + " m/s.",
            remedy_for_speed(scene, speed)};
  }
  if (state.contact_totals.deepest_penetration >= 1.0) {
    return {RunStatus::Kind::contact_lost,
            "A beam has sunk into another by " + percent_of(state.contact_totals.deepest_penetration) +
                " of the thinner one's thickness by " + moment_of(state.step, state.time) +
                deepest_place(scene, state) + "; velocities differed by up to " +
                to_text(std::round(speed / 100.0) / 10.0) + " m/s.",
            remedy_for_speed(scene, 2.0 * std::max(speed, speed_of_step(scene)))};
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
    return {
        RunStatus::Kind::overcompaction,
        words_of(sample.densest_layer) + " at " + moment_of(state.step, state.time) + ", strain " +
            to_text(std::round(1e3 * sample.strain) / 1e3) +
            ". Walls overlap there by more than contacts can bear: the forces are no longer those of metal.",
        "Give a smaller loading.end_strain, or an elements_per_wall of at least 2. The samples before are kept; from a "
        "solid fraction of 1 on, take their stresses as a lower bound."};
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
  const auto go_on = [&status](const auto& check) {
    if (status.kind == RunStatus::Kind::running) {
      status = check();
    }
  };
  go_on([&] { return check_contacts(scene, state); });
  go_on([&] { return check_energy(scene, state, sample); });
  go_on([&] { return check_walls(scene, state, sample); });
  go_on([&] { return check_inertia(scene, state, sample); });
  return status;
}

}  // namespace cellcrush
