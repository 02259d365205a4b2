#include "energy/ledger.h"

#include "beam/beam_section.h"
#include "beam/element_place.h"
#include "energy/wide_energy.h"
#include "simd/target.h"
#include "step/rigid_motion.h"
#include "step/wide_motion.h"

namespace cellcrush {
namespace {

/// Kinetic energy at the state's time, and the half of the newest forces' work that belongs to the interval up to it.
struct Instant {
  double kinetic = 0.0;
  Ledger half;
};

Instant look_at_motion(const Scene& scene, const State& state) {
  const double half = 0.5 * scene.schedule.time_step;
  Instant instant;
  const DampedStep damped = damped_step_of(scene);
  double twice = 0.0;
  for (std::size_t body = 0; body < scene.rigid.count(); ++body) {
    const NextVelocity next = next_velocity_of_body(scene, state, body);
    visit_body(scene, state, body, next, [&](std::size_t i, const NextVelocity& of_particle) {
      accumulate_work(scene, state, i, of_particle, {half * state.velocity[i], half * state.spin[i]}, instant.half);
    });
    twice += scene.rigid.mass[body] * state.rigid_velocity[body].dot(next.velocity) +
             scene.rigid.inertia[body] * state.rigid_spin[body] * next.spin;
  }
  if (have_wide_motion(scene)) {
    const WorksOfMotion works = look_at_particles_wide(scene, state);
    works.book(instant.half);
    twice += works.twice_kinetic;
  } else {
    for (std::size_t i = first_free_particle(scene); i < scene.particle_count(); ++i) {
      const NextVelocity next = next_velocity(scene, state, damped, i);
      accumulate_work(scene, state, i, next, {half * state.velocity[i], half * state.spin[i]}, instant.half);
      twice += scene.mass[i] * state.velocity[i].dot(next.velocity) + scene.inertia[i] * state.spin[i] * next.spin;
    }
  }
  accumulate_plate_work(state, half * scene.plates.speed_at(state.time - half), instant.half);
  instant.kinetic = 0.5 * twice;
  return instant;
}

template <class T>
double elastic_energy_plain(const Scene& scene, const State& state, const FibreMemory<T>& memory) {
  const SectionRule& rule = scene.section;
  double energy = 0.0;
  visit_elements(scene, [&](const ElementPlace& place, int wall) {
    double squares = 0.0;
    std::size_t fibre = 0;
    for (const double along : rule.along_weight) {
      for (const double through : rule.depth_weight) {
        const double stress = memory.stress[place.index(rule.fibre_count(), fibre++)];
        squares += along * through * stress * stress;
      }
    }
    const BeamSection section = section_of(scene, wall, state.length[place.element]);
    const double modulus = section.stiffness * scene.materials[scene.walls.material[wall]].youngs_modulus;
    energy += section.volume * squares / (2.0 * modulus);
  });
  return energy;
}

double elastic_energy(const Scene& scene, const State& state) {
  if (use_wide_kernels()) {
    return elastic_energy_wide(scene, state);
  }
  return scene.single_fibres ? elastic_energy_plain(scene, state, state.single_fibres)
                             : elastic_energy_plain(scene, state, state.fibres);
}

}  // namespace

void accumulate_work(const Scene& scene, const State& state, std::size_t particle, const NextVelocity& next,
                     const MeanMotion& mean, Ledger& ledger) {
  ledger.contact -= state.contact_force[particle].elastic.dot(mean.displacement);
  ledger.contact_damping -= state.contact_force[particle].viscous.dot(mean.displacement);
  if (scene.mass_damping > 0.0) {
    const double half = 0.5 * scene.mass_damping;
    ledger.mass_damping +=
        half * (scene.mass[particle] * (state.velocity[particle] + next.velocity).dot(mean.displacement) +
                scene.inertia[particle] * (state.spin[particle] + next.spin) * mean.turn);
  }
  if (!state.friction_force.empty()) {
    ledger.friction -= state.friction_force[particle].dot(mean.displacement);
  }
  if (scene.is_loaded()) {
    ledger.external += state.load_force[particle].dot(mean.displacement) + state.load_moment[particle] * mean.turn;
  }
  if (!scene.motions.empty()) {
    ledger.external += next.reaction.dot(mean.displacement) + next.reaction_moment * mean.turn;
  }
}

void accumulate_plate_work(const State& state, double displacement, Ledger& ledger) {
  ledger.contact += state.impact_force.elastic * displacement;
  ledger.contact_damping += state.impact_force.viscous * displacement;
  ledger.external += state.impact_force.total() * displacement;
}

void open_ledger(const Scene& scene, State& state) {
  const Instant start = look_at_motion(scene, state);
  state.ledger.contact -= start.half.contact;
  state.ledger.contact_damping -= start.half.contact_damping;
  state.ledger.friction -= start.half.friction;
  state.ledger.mass_damping -= start.half.mass_damping;
  state.ledger.external -= start.half.external;
  state.ledger.initial = start.kinetic;
}

Energies evaluate_energies(const Scene& scene, const State& state) {
  const Instant now = look_at_motion(scene, state);
  Energies energies;
  energies.kinetic = now.kinetic;
  energies.elastic = elastic_energy(scene, state);
  energies.plastic = state.ledger.plastic;
  energies.contact = state.ledger.contact + now.half.contact;
  energies.contact_damping = state.ledger.contact_damping + now.half.contact_damping;
  energies.friction = state.ledger.friction + now.half.friction;
  energies.mass_damping = state.ledger.mass_damping + now.half.mass_damping;
  energies.external = state.ledger.external + now.half.external;
  energies.residual = energies.external + state.ledger.initial - energies.kinetic - energies.elastic -
                      energies.plastic - energies.contact - energies.contact_damping - energies.friction -
                      energies.mass_damping;
  return energies;
}

}  // namespace cellcrush
