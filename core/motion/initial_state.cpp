#include "motion/initial_state.h"

#include <cmath>

#include "motion/particle_motion-inl.h"
#include "motion/rigid_motion.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush {
namespace {

/// Fibres that are free of stress and have never yielded.
template <class T>
void place_fibres(const Scene& scene, FibreHistory<T>& fibres) {
  const std::size_t elements = scene.element_count();
  fibres.stress.assign(elements * scene.fibre_count(), T(0.0));
  const LawFacts& law = Laws::kFacts[scene.law];
  if (law.keeps_back_stress) {
    fibres.back_stress.assign(elements * scene.fibre_count(), T(0.0));
  }
  if (law.keeps_tangent) {
    fibres.tangent.assign(elements * scene.fibre_count(), T(0.0));
    fibres.flow.assign(elements * scene.fibre_count(), T(0.0));
  }
  if (law.keeps_plastic_strain) {
    fibres.plastic_strain.assign(elements * scene.fibre_count(), T(0.0));
  } else {
    fibres.yielded.assign(elements, 0);
  }
  if (scene.section.force_based) {
    fibres.section_axial.assign(elements * scene.section.section_count(), T(0.0));
    fibres.section_moment.assign(elements * scene.section.section_count(), T(0.0));
    fibres.yielding.assign(elements, 0);
    fibres.end_force.assign(elements * kEndForces, T(0.0));
    fibres.owed.assign(elements, T(0.0));
    fibres.shear.assign(scene.walls.shear.empty() ? 0 : elements, T(0.0));
  }
}

/// Turns of the ends of elements against their axes at the start (E5j): walls that are drawn curved have one tangent at
/// a node between two elements, and at their ends the curvature beside. REQUIRES: axes are set.
void place_turns(const Scene& scene, State& state) {
  state.start_turn.assign(scene.element_count(), 0.0);
  state.end_turn.assign(scene.element_count(), 0.0);
  for (const WallBlock& block : scene.walls.blocks) {
    for (int wall = 0; wall < block.walls; ++wall) {
      const auto element = [&](int j) { return block.first_element + j * block.walls + wall; };
      for (int j = 1; j < block.elements; ++j) {
        const Vector2& before = state.axis[element(j - 1)];
        const Vector2& after = state.axis[element(j)];
        const double half = 0.5 * std::atan2(cross(before, after), before.dot(after));
        state.end_turn[element(j - 1)] = half;
        state.start_turn[element(j)] = -half;
      }
      state.start_turn[element(0)] = -state.end_turn[element(0)];
      state.end_turn[element(block.elements - 1)] = -state.start_turn[element(block.elements - 1)];
    }
  }
}

}  // namespace

State place_particles(const Scene& scene) {
  const std::size_t n = scene.particle_count();
  State state;
  state.position.assign(scene.position.begin(), scene.position.end());
  state.velocity.assign(scene.initial_velocity.begin(), scene.initial_velocity.end());
  state.velocity.resize(n, Vector2::Zero());
  state.spin.assign(scene.initial_spin.begin(), scene.initial_spin.end());
  state.spin.resize(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (scene.inertia[i] == 0.0) {
      state.spin[i] = 0.0;  // a node between a pair of elements (E5b)
    }
  }
  state.rotation.assign(n, 0.0);
  state.length.reserve(scene.element_count());
  state.inverse_length.reserve(scene.element_count());
  state.axis.reserve(scene.element_count());
  for (const Element& element : scene.elements) {
    const Vector2 span = scene.position[element.end] - scene.position[element.start];
    state.length.push_back(span.norm());
    state.inverse_length.push_back(1.0 / span.norm());
    state.axis.push_back(span / state.length.back());
  }
  state.shortening.assign(scene.element_count(), 1.0);
  if (scene.thickens()) {
    state.thickening.assign(scene.element_count(), 0.0);
    state.thickening_slope.assign(scene.element_count(), 0.0);
    state.radius_growth.assign(n, 0.0);
  }
  if (scene.section.coupled_bending) {
    place_turns(scene, state);
  }
  scene.single_fibres ? place_fibres(scene, state.single_fibres) : place_fibres(scene, state.fibres);
  state.wall_force.assign(2 * scene.walls.start.size(), Vector2::Zero());
  state.wall_moment.assign(2 * scene.walls.start.size(), 0.0);
  state.internal_force.assign(n, Vector2::Zero());
  state.internal_moment.assign(n, 0.0);
  state.contact_force.assign(n, ContactForce());
  if (scene.contact.bends) {
    state.contact_moment.assign(n, 0.0);
  }
  if (scene.contact.friction > 0.0) {
    state.friction_force.assign(n, Vector2::Zero());
  }
  if (scene.is_loaded()) {
    state.load_force.assign(n, Vector2::Zero());
    state.load_moment.assign(n, 0.0);
  }
  state.reaction_impulse.resize(scene.supports.size());
  if (scene.contact.most_travel > 0.0) {
    state.fastest_step.resize(1);
  }
  state.contacts.resize(scene.bands.size());
  if (scene.can_break()) {
    state.net_strain.resize(2 * scene.section.section_count() * scene.element_count());
  }
  const Scene& touching = scene.repeated != nullptr ? *scene.repeated : scene;
  state.parted.assign(touching.start_overlaps.pairs.size(), 0);
  if (scene.period.repeats()) {
    state.sides = {{scene.period.length, 0.0, 0.0}};
    state.side_force.resize(1);
  }
  state.rigid_centre = scene.rigid.centre;
  state.rigid_velocity.assign(scene.rigid.count(), Vector2::Zero());
  state.rigid_rotation.assign(scene.rigid.count(), 0.0);
  state.rigid_spin.assign(scene.rigid.count(), 0.0);
  start_rigid_bodies(scene, state);
  return state;
}

void stagger_velocities(const Scene& scene, State& state) {
  using namespace HWY_NAMESPACE;
  using One = hn::CappedTag<double, 1>;
  stagger_rigid_bodies(scene, state);
  const StepFactors step = step_factors_of(scene);
  const ParticleArrays<const State> arrays(scene, state);
  with_force_kinds(scene, state, [&](auto kinds) {
    using Kinds = decltype(kinds);
    for (std::size_t i = scene.rigid.particle_count(); i < scene.particle_count(); ++i) {
      const auto motion = motion_of<Kinds>(arrays, step, forces_on<true, Kinds, One>(arrays, i), i);
      const Lane<One> half = 0.5;
      (motion.velocity - half * (motion.next - motion.velocity)).store(&state.velocity[i]);
      (motion.spin - half * (motion.next_spin - motion.spin)).store(&state.spin[i]);
    }
  });
}

}  // namespace cellcrush
HWY_AFTER_NAMESPACE();
