#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/array_shape.h"
#include "cellcrush/byte_stream.h"
#include "cellcrush/contact_lists.h"
#include "cellcrush/lane_vector.h"
#include "cellcrush/tuning.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// History of the fibres and sections of elements, in numbers of type T. E elements of F fibres and P sections, in the
/// order of beam/element_place.h. MPa.
template <class T>
struct FibreHistory {
  using Bits = std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;
  static constexpr unsigned kPrecision = sizeof(T) == sizeof(double) ? kDoubleFibres : kSingleFibres;

  LaneVector<T> stress;          ///< E x F, sigma of E6
  LaneVector<T> back_stress;     ///< E x F, centre of the yield surface (alpha of E6); empty without hardening
  LaneVector<T> plastic_strain;  ///< E x F, accumulated (effective), ep of E6; empty without hardening
  LaneVector<Bits> yielded;      ///< E, bit f: fibre f has yielded; empty with hardening

  // Force-based rules only (E5b, beam/section_balance-inl.h), otherwise empty.
  LaneVector<T> section_moment_residual;  ///< E x P, u_i over b h^2
  LaneVector<T> section_flexibility;      ///< E x P, 1 / t_i, dimensionless
  LaneVector<T> start_moment;             ///< E, on the start node, over b h^2
  LaneVector<T> end_moment;               ///< E, on the end node, over b h^2
};

/// Contact force on a particle, N. The two parts stand side by side because the same loops write both.
struct ContactForce {
  Vector2 elastic = Vector2::Zero();
  Vector2 viscous = Vector2::Zero();
};

/// Force of a plate, N, compression positive (E9c).
struct PlateForce {
  double elastic = 0.0;
  double viscous = 0.0;

  [[nodiscard]] double total() const { return elastic + viscous; }
};

/// Energies and works accumulated over time (E10), N mm. Written by integrate_motion and evaluate_internal_forces.
struct Ledger {
  double plastic = 0.0;          ///< stress times plastic strain increment
  double contact = 0.0;          ///< work against the elastic normal forces of contacts, walls' and plates'
  double contact_damping = 0.0;  ///< work against the viscous forces of contacts
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;  ///< work of the plates and of nodal loads
  double initial = 0.0;   ///< kinetic energy at the start
};

/// Everything that a step changes. N particles, E elements, F fibres per element. Units mm, tonne, s, N, MPa, rad.
/// visit_fields lists every field once, except derived ones.
struct State {
  std::int64_t step = 0;
  double time = 0.0;

  // Written by integrate_motion.
  LaneVector<Vector2> position;         ///< N
  LaneVector<Vector2> velocity;         ///< N, half a step before `time`
  LaneVector<double> rotation;          ///< N, since the start; for output only
  LaneVector<double> spin;              ///< N, rad/s, half a step before `time`
  std::vector<Vector2> rigid_centre;    ///< B rigid bodies, centre of mass
  std::vector<Vector2> rigid_velocity;  ///< B, half a step before `time`
  std::vector<double> rigid_rotation;   ///< B, since the start
  std::vector<double> rigid_spin;       ///< B, half a step before `time`
  double impact_travel = 0.0;           ///< of the impact plate
  double impact_impulse = 0.0;          ///< N s, of the impact plate on the lattice
  double support_impulse = 0.0;         ///< N s, of the support plate on the lattice

  // Written by evaluate_internal_forces.
  LaneVector<Vector2> axis;           ///< E, unit vector from start to end
  LaneVector<double> length;          ///< E
  LaneVector<double> inverse_length;  ///< E, 1/mm
  FibreHistory<double> fibres;        ///< empty where they are in single precision
  FibreHistory<float> single_fibres;  ///< empty where they are in double precision
  /// 2 W, forces of walls on joints, N: for each block, those at the starts of its walls, then at their ends.
  LaneVector<Vector2> wall_force;
  LaneVector<double> wall_moment;      ///< 2 W, N mm
  LaneVector<Vector2> internal_force;  ///< N, sum of the forces of all elements on the particle
  LaneVector<double> internal_moment;  ///< N, N mm

  // Written by evaluate_loads; empty when the scene has no loads.
  std::vector<Vector2> load_force;  ///< N
  std::vector<double> load_moment;  ///< N, N mm

  /// One entry for each band of the lattice (Scene::bands), in order. A single entry if the lattice is not cut into
  /// bands.
  std::vector<ContactLists> contacts = std::vector<ContactLists>(1);
  /// Step in which walls were found to have crossed; from then on contacts are searched by buckets. -1: none.
  std::int64_t crossing_step = -1;

  // Written by evaluate_contact_forces and evaluate_plate_forces, which add to forces that integrate_motion has
  // cleared.
  LaneVector<ContactForce> contact_force;  ///< N, of walls and plates
  std::vector<Vector2> friction_force;     ///< N, of walls and plates; empty without friction
  std::vector<double> impact_friction;     ///< N, of the impact plate across the crush; empty without friction
  std::vector<double> support_friction;    ///< N, of the support plate across the crush; empty without friction
  PlateForce impact_force;                 ///< of the impact plate on the lattice, along the crush
  PlateForce support_force;                ///< of the support plate on the lattice, against the crush
  ContactTotals contact_totals;

  Ledger ledger;

  /// Derived, so visit_fields leaves it out. A bit for each tile of kContactTile particles: whether one of them may
  /// have a contact_force; most have none. Rebuilt from the touching pairs every 64 steps; in between, tiles are only
  /// marked. Empty: any particle may have one.
  std::vector<std::uint64_t> contact_tiles;
};

template <class F, class Visitor>
void visit_fibre_fields(F& fibres, Visitor&& visitor) {
  auto& [stress, back_stress, plastic_strain, yielded, section_moment_residual, section_flexibility, start_moment,
         end_moment] = fibres;
  constexpr unsigned kPrecision = F::kPrecision;
  visitor("stress", stress, Shape(Per::fibre, kPrecision));
  visitor("back_stress", back_stress, Shape(Per::fibre, kPrecision | kHardening));
  visitor("plastic_strain", plastic_strain, Shape(Per::fibre, kPrecision | kHardening));
  visitor("yielded", yielded, Shape(Per::element, kPrecision | kNoHardening));
  visitor("section_moment_residual", section_moment_residual, Shape(Per::section, kPrecision | kForceBased));
  visitor("section_flexibility", section_flexibility, Shape(Per::section, kPrecision | kForceBased));
  visitor("start_moment", start_moment, Shape(Per::element, kPrecision | kForceBased));
  visitor("end_moment", end_moment, Shape(Per::element, kPrecision | kForceBased));
}

/// Calls visitor(name, field, shape) for every field of the state, in the order of a checkpoint; the shape gives the
/// number of entries of an array. This is the only list of the state: checkpoint, hash, memory and large pages use it.
/// It decomposes the state, so a new field does not compile until it is listed. A field is an arithmetic value or a
/// vector of trivially copyable values.
template <class S, class Visitor>
void visit_fields(S& state, Visitor&& visitor) {
  auto& [step, time, position, velocity, rotation, spin, rigid_centre, rigid_velocity, rigid_rotation, rigid_spin,
         impact_travel, impact_impulse, support_impulse, axis, length, inverse_length, fibres, single_fibres,
         wall_force, wall_moment, internal_force, internal_moment, load_force, load_moment, contacts, crossing_step,
         contact_force, friction_force, impact_friction, support_friction, impact_force, support_force, contact_totals,
         ledger, derived_tiles] = state;
  visitor("step", step, Per::few);
  visitor("time", time, Per::few);
  visitor("position", position, Per::particle);
  visitor("velocity", velocity, Per::particle);
  visitor("rotation", rotation, Per::particle);
  visitor("spin", spin, Per::particle);
  visitor("rigid_centre", rigid_centre, Per::rigid_body);
  visitor("rigid_velocity", rigid_velocity, Per::rigid_body);
  visitor("rigid_rotation", rigid_rotation, Per::rigid_body);
  visitor("rigid_spin", rigid_spin, Per::rigid_body);
  visitor("impact_travel", impact_travel, Per::few);
  visitor("impact_impulse", impact_impulse, Per::few);
  visitor("support_impulse", support_impulse, Per::few);
  visitor("axis", axis, Per::element);
  visitor("length", length, Per::element);
  visitor("inverse_length", inverse_length, Per::element);
  visit_fibre_fields(fibres, visitor);
  visit_fibre_fields(single_fibres, visitor);
  visitor("wall_force", wall_force, Shape(Per::wall, kAlways, 2));
  visitor("wall_moment", wall_moment, Shape(Per::wall, kAlways, 2));
  visitor("internal_force", internal_force, Per::particle);
  visitor("internal_moment", internal_moment, Per::particle);
  visitor("load_force", load_force, Shape(Per::particle, kLoads));
  visitor("load_moment", load_moment, Shape(Per::particle, kLoads));
  for (auto& lists : contacts) {
    visit_search_fields(lists, visitor);
  }
  visitor("crossing_step", crossing_step, Per::few);
  for (auto& lists : contacts) {
    visit_touch_fields(lists, visitor);
  }
  visitor("contact_force", contact_force, Per::particle);
  visitor("friction_force", friction_force, Shape(Per::particle, kFriction));
  visitor("impact_friction", impact_friction, Shape(Per::particle, kPlateFriction));
  visitor("support_friction", support_friction, Shape(Per::particle, kPlateFriction));
  visitor("impact_force", impact_force, Per::few);
  visitor("support_force", support_force, Per::few);
  visitor("contact_stored", contact_totals.stored, Per::few);
  visitor("contact_count", contact_totals.count, Per::few);
  visitor("deepest_penetration", contact_totals.deepest_penetration, Per::few);
  visitor("deepest_birth", contact_totals.deepest_birth, Per::few);
  visitor("ledger", ledger, Per::few);
}

/// The same for the arrays alone, the derived ones too.
template <class Visitor>
void visit_arrays(const State& state, Visitor&& visitor) {
  visit_fields(state, [&visitor](const char* name, const auto& field, Shape shape) {
    if constexpr (requires { field.data(); }) {
      visitor(name, field, shape);
    }
  });
  visitor("contact_tiles", state.contact_tiles, Per::few);
}

/// Every field in its memory representation, for the same build on the same kind of processor.
inline void put_state(ByteWriter& writer, const State& state) {
  visit_fields(state, [&writer](const char*, const auto& field, Shape) { writer.put(field); });
}
inline void take_state(ByteReader& reader, State& state) {
  visit_fields(state, [&reader](const char*, auto& field, Shape) { reader.take(field); });
}

}  // namespace cellcrush
