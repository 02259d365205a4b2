#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/breaks.h"
#include "cellcrush/byte_stream.h"
#include "cellcrush/contact_lists.h"
#include "cellcrush/ledger.h"
#include "cellcrush/tuning.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// Forces of a unit that an element keeps (E5h): its axial force and outer moment, and at the first element the moment
/// that the elements of the unit share.
inline constexpr std::size_t kEndForces = 3;

/// History of the fibres and sections of elements, in numbers of type T. E elements of F fibres and P sections, in the
/// order of beam/element_place.h. MPa.
template <class T>
struct FibreHistory {
  using Bits = std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;

  LaneVector<T> stress;          ///< E x F, sigma of E6
  LaneVector<T> back_stress;     ///< E x F, centre of the yield surface (alpha of E6); empty unless the law keeps it
  LaneVector<T> plastic_strain;  ///< E x F, accumulated (effective), ep of E6; empty unless the law keeps it
  LaneVector<T> tangent;         ///< E x F, tangent modulus over E of the last flow; empty unless the law keeps it
  LaneVector<T> flow;            ///< E x F, its plastic strain increment in a step; empty with tangent
  LaneVector<Bits> yielded;      ///< E, bit f: fibre f has yielded; empty with plastic_strain

  // Force-based rules only (E5b, E5d, beam/element_response-inl.h), otherwise empty.
  LaneVector<T> section_axial;   ///< E x P, n: sums over the stresses of the section
  LaneVector<T> section_moment;  ///< E x P, m
  LaneVector<Bits> yielding;     ///< E, bit f: fibre f yielded in the last step
  LaneVector<T> end_force;       ///< E x kEndForces, of the unit
  LaneVector<T> owed;            ///< E, MPa^2, at the first element of a unit: what its work still misses (E5h)
  LaneVector<T> shear;           ///< E, outer moment less the shared one that shear bears (E5i); empty without shear
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

/// Force of a rigid wall on the lattice (E9f).
struct RigidWallForce {
  PlateForce normal;        ///< along its normal
  double tangential = 0.0;  ///< N, friction along its tangent, the normal turned clockwise
};

/// Travel of a rigid wall along its normal.
struct RigidWallMotion {
  double travel = 0.0;  ///< mm
  double speed = 0.0;   ///< mm/s, half a step before `time`
  double way = 0.0;     ///< mm, of the work of the forces before: half a step before and half a step after them
};

/// Distance of sides that repeat (E9i).
struct SidesMotion {
  double width = 0.0;  ///< mm
  double speed = 0.0;  ///< mm/s, half a step before `time`
  double way = 0.0;    ///< mm, of the work of the forces before: half a step before and half a step after them
};

/// Force of contacts across such sides that widens them, N.
struct SideForce {
  double elastic = 0.0;
  double viscous = 0.0;
  double friction = 0.0;

  [[nodiscard]] double total() const { return elastic + viscous + friction; }
};

/// Speed of an impact plate that is controlled: changes evenly from one setting to the next.
struct PlateDrive {
  double since = 0.0;  ///< s
  double speed = 0.0;  ///< mm/s, then
  double rate = 0.0;   ///< mm/s^2
};

/// What a rigid wall has done to the lattice since the start.
struct RigidWallTotals {
  double normal = 0.0;      ///< N s, impulse along its normal
  double tangential = 0.0;  ///< N s
  double work = 0.0;        ///< N mm
};

/// Impulse of a support on a particle since the start: N s along x and y, and N mm s (E15).
struct ReactionImpulse {
  double x = 0.0;
  double y = 0.0;
  double moment = 0.0;
};

/// The step since the start in which particles could approach each other by the most (watch_approach in step/stages.h).
struct FastestStep {
  double travel = 0.0;        ///< mm
  std::int64_t step = 0;      ///< 0: none yet
  std::int64_t particle = 0;  ///< whose velocity is farthest from the middle of all
};

/// Everything that a step changes. N particles, E elements, F fibres per element. Units mm, tonne, s, N, MPa, rad.
/// visit_fields lists every field once, except derived ones.
struct State {
  std::int64_t step = 0;
  double time = 0.0;

  // Written by integrate_motion.
  LaneVector<Vector2> position;                    ///< N
  LaneVector<Vector2> velocity;                    ///< N, half a step before `time`
  LaneVector<double> rotation;                     ///< N, since the start; for output only
  LaneVector<double> spin;                         ///< N, rad/s, half a step before `time`
  std::vector<Vector2> rigid_centre;               ///< B rigid bodies, centre of mass
  std::vector<Vector2> rigid_velocity;             ///< B, half a step before `time`
  std::vector<double> rigid_rotation;              ///< B, since the start
  std::vector<double> rigid_spin;                  ///< B, half a step before `time`
  std::vector<ReactionImpulse> reaction_impulse;   ///< N; empty if nothing is held
  double impact_travel = 0.0;                      ///< of the impact plate
  double impact_impulse = 0.0;                     ///< N s, of the impact plate on the lattice
  double support_impulse = 0.0;                    ///< N s, of the support plate on the lattice
  std::vector<RigidWallMotion> rigid_wall_motion;  ///< one for each of Scene::rigid_walls
  std::vector<RigidWallTotals> rigid_wall_totals;  ///< one for each of Scene::rigid_walls

  // Written by evaluate_internal_forces.
  LaneVector<Vector2> axis;             ///< E, unit vector from start to end
  LaneVector<double> length;            ///< E
  LaneVector<double> inverse_length;    ///< E, 1/mm
  LaneVector<double> shortening;        ///< E, l_0 / L, at least 1; L is the length without elastic strain (E5c)
  LaneVector<double> thickening;        ///< E, growth of half the thickness in contact (E5f); empty at constant area
  LaneVector<double> thickening_slope;  ///< E, its derivative by the length; empty at constant area
  LaneVector<double> radius_growth;     ///< N, what the radius of the ball has grown by (E5f); empty at constant area
  LaneVector<double> start_turn;        ///< E, rad, of the start against the axis (E5j); empty unless they are coupled
  LaneVector<double> end_turn;          ///< E, rad, of the end
  FibreHistory<double> fibres;          ///< empty where they are in single precision
  FibreHistory<float> single_fibres;    ///< empty where they are in double precision
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
  /// Step in which walls were found to have crossed; until the check that ends the run, contacts are searched by
  /// buckets. -1: none.
  std::int64_t crossing_step = -1;

  /// One for each of Scene::start_overlaps, 1: has parted (E8f). Written by find_contacts.
  std::vector<std::uint8_t> parted;
  // Where walls can break (E6g), otherwise empty; written between steps.
  std::vector<Break> breaks;                 ///< so far, in their order
  std::vector<NetPlasticStrain> net_strain;  ///< 2 P E: of the right and the left outer fibre of each section

  // Written by evaluate_contact_forces and evaluate_plate_forces, which add to forces that integrate_motion has
  // cleared.
  LaneVector<ContactForce> contact_force;  ///< N, of walls and plates
  std::vector<double> contact_moment;      ///< N, N mm, of walls (E8e); empty unless segments bend
  std::vector<Vector2> friction_force;     ///< N, of walls and plates; empty without friction
  std::vector<double> impact_friction;     ///< N, of the impact plate across the crush; empty without friction
  std::vector<double> support_friction;    ///< N, of the support plate across the crush; empty without friction
  PlateForce impact_force;                 ///< of the impact plate on the lattice, along the crush
  PlateForce support_force;                ///< of the support plate on the lattice, against the crush
  /// N for each of Scene::rigid_walls, of the wall along its tangent, wall by wall; empty without friction at one.
  std::vector<double> rigid_wall_friction;
  std::vector<RigidWallForce> rigid_wall_force;  ///< one for each of Scene::rigid_walls
  ContactTotals contact_totals;
  std::vector<FastestStep> fastest_step;  ///< one where contacts of a frame are watched; otherwise empty
  std::vector<PlateDrive> plate_drive;    ///< one where the speed of the plate is controlled; otherwise empty
  std::vector<SidesMotion> sides;         ///< one where the sides repeat; otherwise empty
  std::vector<SideForce> side_force;      ///< one where the sides repeat; otherwise empty

  Ledger ledger;

  /// Derived, so visit_fields leaves it out. C chunks of walls: the greatest growth of half of an element's thickness
  /// in the newest step. Empty at constant area.
  std::vector<double> thickening_step;

  /// Derived, so visit_fields leaves it out. A bit for each tile of kContactTile particles: whether one of them may
  /// have a contact_force; most have none. Rebuilt from the touching pairs every 64 steps; in between, tiles are only
  /// marked. Empty: any particle may have one.
  std::vector<std::uint64_t> contact_tiles;
};

/// Calls visit(field) for every field of the state, in the order of a checkpoint. This is the only list of the state:
/// checkpoint, hash, memory and large pages use it. It decomposes the state, so a new field does not compile until it
/// is listed. A field is an arithmetic value, a structure of them without gaps, or a vector of either.
template <class S, class Visitor>
void visit_fields(S& state, Visitor&& visit) {
  auto& [step, time, position, velocity, rotation, spin, rigid_centre, rigid_velocity, rigid_rotation, rigid_spin,
         reaction_impulse, impact_travel, impact_impulse, support_impulse, rigid_wall_motion, rigid_wall_totals, axis,
         length, inverse_length, shortening, thickening, thickening_slope, radius_growth, start_turn, end_turn, fibres,
         single_fibres, wall_force, wall_moment, internal_force, internal_moment, load_force, load_moment, contacts,
         crossing_step, parted, breaks, net_strain, contact_force, contact_moment, friction_force, impact_friction,
         support_friction, impact_force, support_force, rigid_wall_friction, rigid_wall_force, contact_totals,
         fastest_step, plate_drive, sides, side_force, ledger, derived_steps, derived_tiles] = state;
  const auto list = [&visit](auto&... fields) { (visit(fields), ...); };
  const auto list_fibres = [&list](auto& history) {
    auto& [stress, back_stress, plastic_strain, tangent, flow, yielded, section_axial, section_moment, yielding,
           end_force, owed, shear] = history;
    list(stress, back_stress, plastic_strain, tangent, flow, yielded, section_axial, section_moment, yielding,
         end_force, owed, shear);
  };
  list(step, time, position, velocity, rotation, spin, rigid_centre, rigid_velocity, rigid_rotation, rigid_spin,
       reaction_impulse, impact_travel, impact_impulse, support_impulse, rigid_wall_motion, rigid_wall_totals, axis,
       length, inverse_length, shortening, thickening, thickening_slope, radius_growth, start_turn, end_turn);
  list_fibres(fibres);
  list_fibres(single_fibres);
  list(wall_force, wall_moment, internal_force, internal_moment, load_force, load_moment);
  for (auto& lists : contacts) {
    visit_search_fields(lists, visit);
  }
  list(crossing_step, parted, breaks, net_strain);
  for (auto& lists : contacts) {
    visit_touch_fields(lists, visit);
  }
  list(contact_force, contact_moment, friction_force, impact_friction, support_friction, impact_force, support_force,
       rigid_wall_friction, rigid_wall_force, contact_totals, fastest_step, plate_drive, sides, side_force, ledger);
}

/// The same for the arrays alone, the derived ones too.
template <class Visitor>
void visit_arrays(const State& state, Visitor&& visit) {
  visit_fields(state, [&visit](const auto& field) {
    if constexpr (requires { field.data(); }) {
      visit(field);
    }
  });
  visit(state.thickening_step);
  visit(state.contact_tiles);
}

/// Every field in its memory representation, for the same build on the same kind of processor.
inline void put_state(ByteWriter& writer, const State& state) {
  visit_fields(state, [&writer](const auto& field) { writer.put(field); });
}
inline void take_state(ByteReader& reader, State& state) {
  visit_fields(state, [&reader](auto& field) { reader.take(field); });
}

}  // namespace cellcrush
