#include "energy/ledger.h"

#include "beam/beam_section.h"
#include "beam/element_place.h"

namespace cellcrush {
namespace {

/// Books the half of the newest forces' work that belongs to the interval up to the state's time; `sign` is +1 to add it.
void close_interval(const Scene& scene, const State& state, double sign, Ledger& ledger) {
  const double half = 0.5 * scene.schedule.time_step;
  Ledger open;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const MeanMotion mean = {half * state.velocity[i], half * state.spin[i]};
    accumulate_work(scene, state, i, next_velocity(scene, state, i), mean, open);
  }
  accumulate_plate_work(state, half * scene.plates.speed_at(state.time - half), open);
  ledger.contact += sign * open.contact;
  ledger.contact_damping += sign * open.contact_damping;
  ledger.friction += sign * open.friction;
  ledger.mass_damping += sign * open.mass_damping;
  ledger.external += sign * open.external;
}

double kinetic_energy(const Scene& scene, const State& state) {
  double twice = 0.0;
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    const NextVelocity next = next_velocity(scene, state, i);
    twice += scene.mass[i] * state.velocity[i].dot(next.velocity) + scene.inertia[i] * state.spin[i] * next.spin;
  }
  return 0.5 * twice;
}

using StridedMap = Eigen::Map<const Eigen::ArrayXXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>>;

double elastic_energy(const Scene& scene, const State& state) {
  const auto sections = static_cast<Eigen::Index>(scene.section.section_count());
  const auto depth = static_cast<Eigen::Index>(scene.section.depth_count());
  double energy = 0.0;
  visit_elements(scene, [&](const ElementPlace& place, int wall) {
    const StridedMap stress(&state.stress[place.index(scene.fibre_count(), 0)], depth, sections,
                            {depth * static_cast<Eigen::Index>(place.stride), static_cast<Eigen::Index>(place.stride)});
    const BeamSection section = section_of(scene, wall, state.length[place.element]);
    const double modulus = section.stiffness * scene.materials[scene.walls.material[wall]].youngs_modulus;
    energy += section.volume * mean_over(scene.section, stress.square()) / (2.0 * modulus);
  });
  return energy;
}

}  // namespace

void accumulate_work(const Scene& scene, const State& state, std::size_t particle, const NextVelocity& next,
                     const MeanMotion& mean, Ledger& ledger) {
  ledger.contact -= state.contact_force[particle].dot(mean.displacement);
  ledger.contact_damping -= state.contact_damping_force[particle].dot(mean.displacement);
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
  close_interval(scene, state, -1.0, state.ledger);
  state.ledger.initial = kinetic_energy(scene, state);
}

Energies evaluate_energies(const Scene& scene, const State& state) {
  Ledger ledger = state.ledger;
  close_interval(scene, state, 1.0, ledger);
  Energies energies;
  energies.kinetic = kinetic_energy(scene, state);
  energies.elastic = elastic_energy(scene, state);
  energies.plastic = ledger.plastic;
  energies.contact = ledger.contact;
  energies.contact_damping = ledger.contact_damping;
  energies.friction = ledger.friction;
  energies.mass_damping = ledger.mass_damping;
  energies.external = ledger.external;
  energies.residual = energies.external + ledger.initial - energies.kinetic - energies.elastic - energies.plastic -
                      energies.contact - energies.contact_damping - energies.friction - energies.mass_damping;
  return energies;
}

}  // namespace cellcrush
