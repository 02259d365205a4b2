#include "energy/ledger.h"

#include <array>
#include <vector>

#include "beam/beam_section.h"
#include "beam/element_place.h"
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

/// Weighted squares of the stresses of a row's elements, whose values of a fibre lie side by side. A full row's loops have
/// fixed bounds, so that the compiler makes vectors of them.
template <int kWalls, class T>
std::array<T, kMostWallsInBlock> weighted_squares(const std::vector<T>& weight, const T* stress, int walls) {
  const int count = kWalls > 0 ? kWalls : walls;
  std::array<T, kMostWallsInBlock> squares{};
  for (const T of_fibre : weight) {
    for (int w = 0; w < count; ++w) {
      squares[w] += of_fibre * stress[w] * stress[w];
    }
    stress += count;
  }
  return squares;
}

template <class T>
double elastic_energy(const Scene& scene, const State& state, const FibreMemory<T>& memory) {
  const SectionRule& rule = scene.section;
  std::vector<T> weight;
  for (const double along : rule.along_weight) {
    for (const double through : rule.depth_weight) {
      weight.push_back(static_cast<T>(along * through));
    }
  }
  double energy = 0.0;
  visit_rows(scene, [&](const WallBlock& block, std::size_t row) {
    const T* stress = &memory.stress[row * weight.size()];
    const auto squares = block.walls == kMostWallsInBlock
                             ? weighted_squares<kMostWallsInBlock>(weight, stress, block.walls)
                             : weighted_squares<0>(weight, stress, block.walls);
    for (int w = 0; w < block.walls; ++w) {
      const int wall = block.first_wall + w;
      const BeamSection section = section_of(scene, wall, state.length[row + w]);
      const double modulus = section.stiffness * scene.materials[scene.walls.material[wall]].youngs_modulus;
      energy += section.volume * static_cast<double>(squares[w]) / (2.0 * modulus);
    }
  });
  return energy;
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
  energies.elastic = scene.single_fibres ? elastic_energy(scene, state, state.single_fibres)
                                         : elastic_energy(scene, state, state.fibres);
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
