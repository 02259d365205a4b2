#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/byte_stream.h"
#include "cellcrush/lane_vector.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// What is remembered of the T pairs of a ball and a segment that touch; by ball, segments ascending.
struct TouchMemory {
  std::vector<int> ball;      ///< T, particle
  std::vector<int> segment;   ///< T, element
  std::vector<double> reach;  ///< T, mm, distance at which they touch
  std::vector<int> place;     ///< T, of the candidate by which the pair was found; its list may be another since then
  std::vector<int> linked;    ///< T, 1: shares a particle with the segment of another of the ball's pairs; 0: with none
  std::vector<int> side;      ///< T, +1 left, -1 right of the segment: where the ball is, or came from; 0: has parted
  std::vector<int> pushed;    ///< T, the side from which it pushed on the ball with friction in the newest step; 0: it
                              ///< did not. Empty without friction
  std::vector<double>
      friction;  ///< T, N, on the ball, along the segment, round its ends with it; kept while it pushes.
                 ///< Empty without friction

  [[nodiscard]] std::size_t count() const { return ball.size(); }
};

/// What the fibres and the sections of elements remember, in numbers of type T. E elements of F fibres and P sections; the
/// order is that of beam/element_place.h. MPa.
template <class T>
struct FibreMemory {
  using Bits = std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;

  LaneVector<T> stress;          ///< E x F
  LaneVector<T> back_stress;     ///< E x F, middle of the yield surface; empty without hardening
  LaneVector<T> plastic_strain;  ///< E x F, accumulated (effective); empty without hardening
  LaneVector<Bits> flowed;       ///< E, bit f: fibre f has flowed; empty with hardening

  // Of a force-based rule (beam/section_curvatures.h), else empty.
  LaneVector<T> section_unbalance;    ///< E x P
  LaneVector<T> section_flexibility;  ///< E x P, 1
  LaneVector<T> start_moment;         ///< E, on the start node, over b h^2
  LaneVector<T> end_moment;           ///< E, on the end node, over b h^2
};

/// Candidates that stand together, of one face.
inline constexpr int kCandidateBatch = 8;

/// Where the candidates of a face stand: `count` of them from `first` on, then empty places up to `room`; whole batches.
struct FaceList {
  int first = 0;
  int count = 0;
  int room = 0;
  int group = 0;  ///< of faces, to which it belongs
};

/// Force of contacts on a particle, N. Side by side, as those who write the one write the other.
struct ContactForce {
  Vector2 elastic = Vector2::Zero();
  Vector2 viscous = Vector2::Zero();
};

/// Force of a plate, N, compression positive.
struct PlateForce {
  double elastic = 0.0;
  double viscous = 0.0;

  [[nodiscard]] double total() const { return elastic + viscous; }
};

/// Energies and works that are sums over time. N mm. Written by integrate_motion and evaluate_internal_forces.
struct Ledger {
  double plastic = 0.0;          ///< stress times plastic strain increment
  double contact = 0.0;          ///< work against the elastic normal forces of contacts, walls' and plates'
  double contact_damping = 0.0;  ///< work against the viscous forces of contacts
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;  ///< work of the plates and of nodal loads
  double initial = 0.0;   ///< kinetic energy at the start
};

/// Everything that a step changes. N particles, E elements, F fibres an element. Units mm, tonne, s, N, MPa, rad.
/// visit_fields lists every field once, but what is derived; checkpoint, hash and comparison go through it.
struct State {
  std::int64_t step = 0;
  double time = 0.0;

  // Written by integrate_motion.
  LaneVector<Vector2> position;         ///< N
  LaneVector<Vector2> velocity;         ///< N, half a step before `time`
  LaneVector<double> rotation;          ///< N, since the start; for output only
  LaneVector<double> spin;              ///< N, rad/s, half a step before `time`
  std::vector<Vector2> rigid_centre;    ///< B rigid bodies, of mass
  std::vector<Vector2> rigid_velocity;  ///< B, half a step before `time`
  std::vector<double> rigid_rotation;   ///< B, since the start
  std::vector<double> rigid_spin;       ///< B, half a step before `time`
  double impact_travel = 0.0;           ///< of the impact plate
  double impact_impulse = 0.0;          ///< N s, of the impact plate on the lattice
  double support_impulse = 0.0;         ///< N s, of the support plate on the lattice

  // Written by evaluate_internal_forces.
  LaneVector<Vector2> axis;            ///< E, unit vector from start to end
  LaneVector<double> length;           ///< E
  LaneVector<double> inverse_length;   ///< E, 1/mm
  FibreMemory<double> fibres;          ///< empty where they are in single precision
  FibreMemory<float> single_fibres;    ///< empty where they are in double precision
  LaneVector<Vector2> wall_force;      ///< 2 W, of walls on joints: of a block's walls at their starts, then ends; N
  LaneVector<double> wall_moment;      ///< 2 W, N mm
  LaneVector<Vector2> internal_force;  ///< N, of all elements on the particle
  LaneVector<double> internal_moment;  ///< N, N mm

  // Written by evaluate_loads; empty when the scene has no loads.
  std::vector<Vector2> load_force;  ///< N
  std::vector<double> load_moment;  ///< N, N mm

  // Written by find_contacts. K places for candidates, in whole batches: balls and segments that may touch before they are
  // looked for again.
  std::vector<int> candidate_ball;      ///< K, particle
  std::vector<int> candidate_segment;   ///< K, element
  std::vector<double> candidate_reach;  ///< K, mm, distance at which they touch; 0: an empty place
  std::int64_t candidate_count = 0;     ///< of the places that are not empty

  // The same, of a search by buckets; empty where contacts are searched by faces.
  LaneVector<Vector2> searched_position;  ///< N, where the particles were when the list was made
  std::int64_t search_count = 0;

  // The same, of a search by faces (contact/face_search.h): F faces, C corners, G groups. Empty when by buckets.
  std::vector<FaceList> face_list;  ///< F
  std::vector<double> face_budget;  ///< F, mm by which gaps may close before a pair that is not listed touches
  std::vector<double> face_alarm;   ///< F, travel of its group at which a face is looked at next
  std::vector<Vector2> face_searched_position;  ///< C, where the corners were when the face's list was made
  std::vector<double> group_travel;             ///< G, mm by which gaps of the group can have closed since the start
  std::vector<double> group_alarm;              ///< G, the least of its faces
  std::vector<int> batch_group;                 ///< K / kCandidateBatch, group of the batch's face
  std::int64_t batch_count = 0;                 ///< batches that the faces' candidates need
  std::int64_t face_look_count = 0;             ///< faces looked at since the start
  std::int64_t face_search_count = 0;           ///< faces whose list was made anew since the start
  std::int64_t crossing_step =
      -1;  ///< in which walls were found to have crossed, from when on the search is by buckets

  // Written by evaluate_contact_forces.
  TouchMemory touching;     ///< of the pairs that touch now, and those that have parted in this step
  std::vector<int> parted;  ///< of `touching`, ascending: those that have parted
  /// K, travel of the group at which a candidate is tested next; infinite while it is in `touching`, and of empty places.
  LaneVector<double> candidate_alarm;

  // Written by evaluate_contact_forces and evaluate_plate_forces, which add up forces that integrate_motion has cleared.
  LaneVector<ContactForce> contact_force;  ///< N, of walls and plates
  std::vector<Vector2> friction_force;     ///< N, of walls and plates; empty without friction
  std::vector<double> impact_friction;     ///< N, of the impact plate across the crush; empty without friction
  std::vector<double> support_friction;    ///< N, of the support plate across the crush; empty without friction
  PlateForce impact_force;                 ///< of the impact plate on the lattice, along the crush
  PlateForce support_force;                ///< of the support plate on the lattice, against the crush
  double contact_stored = 0.0;             ///< sum of k D^2 / 2 now
  std::int64_t contact_count = 0;          ///< closed contacts between walls now
  double deepest_penetration = 0.0;        ///< of a wall contact since the start, over the thinner wall's thickness
  double deepest_birth = 0.0;              ///< the same, of contacts in the step in which they first touched

  Ledger ledger;

  /// Derived, so no field for visit_fields: of each kContactLot particles, whether one may have a contact_force, since most have
  /// none. It is made anew from what touches every so many steps; in between lots are only added. Empty: all may.
  std::vector<std::uint8_t> contact_lots;
  static constexpr std::size_t kContactLot = 8;
};

template <class M, class Visitor>
void visit_fibre_fields(M& memory, Visitor&& visitor) {
  visitor("stress", memory.stress);
  visitor("back_stress", memory.back_stress);
  visitor("plastic_strain", memory.plastic_strain);
  visitor("flowed", memory.flowed);
  visitor("section_unbalance", memory.section_unbalance);
  visitor("section_flexibility", memory.section_flexibility);
  visitor("start_moment", memory.start_moment);
  visitor("end_moment", memory.end_moment);
}

/// Calls visitor(name, field) for every field of the state, in a fixed order. Fields are arithmetic or vectors of trivially
/// copyable things.
template <class S, class Visitor>
void visit_fields(S& state, Visitor&& visitor) {
  visitor("step", state.step);
  visitor("time", state.time);
  visitor("position", state.position);
  visitor("velocity", state.velocity);
  visitor("rotation", state.rotation);
  visitor("spin", state.spin);
  visitor("rigid_centre", state.rigid_centre);
  visitor("rigid_velocity", state.rigid_velocity);
  visitor("rigid_rotation", state.rigid_rotation);
  visitor("rigid_spin", state.rigid_spin);
  visitor("impact_travel", state.impact_travel);
  visitor("impact_impulse", state.impact_impulse);
  visitor("support_impulse", state.support_impulse);
  visitor("axis", state.axis);
  visitor("length", state.length);
  visitor("inverse_length", state.inverse_length);
  visit_fibre_fields(state.fibres, visitor);
  visit_fibre_fields(state.single_fibres, visitor);
  visitor("wall_force", state.wall_force);
  visitor("wall_moment", state.wall_moment);
  visitor("internal_force", state.internal_force);
  visitor("internal_moment", state.internal_moment);
  visitor("load_force", state.load_force);
  visitor("load_moment", state.load_moment);
  visitor("candidate_ball", state.candidate_ball);
  visitor("candidate_segment", state.candidate_segment);
  visitor("candidate_reach", state.candidate_reach);
  visitor("candidate_count", state.candidate_count);
  visitor("searched_position", state.searched_position);
  visitor("search_count", state.search_count);
  visitor("face_list", state.face_list);
  visitor("face_budget", state.face_budget);
  visitor("face_alarm", state.face_alarm);
  visitor("face_searched_position", state.face_searched_position);
  visitor("group_travel", state.group_travel);
  visitor("group_alarm", state.group_alarm);
  visitor("batch_group", state.batch_group);
  visitor("batch_count", state.batch_count);
  visitor("face_look_count", state.face_look_count);
  visitor("face_search_count", state.face_search_count);
  visitor("crossing_step", state.crossing_step);
  visitor("touching_ball", state.touching.ball);
  visitor("touching_segment", state.touching.segment);
  visitor("touching_reach", state.touching.reach);
  visitor("touching_place", state.touching.place);
  visitor("touching_linked", state.touching.linked);
  visitor("touching_side", state.touching.side);
  visitor("touching_pushed", state.touching.pushed);
  visitor("touching_friction", state.touching.friction);
  visitor("parted", state.parted);
  visitor("candidate_alarm", state.candidate_alarm);
  visitor("contact_force", state.contact_force);
  visitor("friction_force", state.friction_force);
  visitor("impact_friction", state.impact_friction);
  visitor("support_friction", state.support_friction);
  visitor("impact_force", state.impact_force);
  visitor("support_force", state.support_force);
  visitor("contact_stored", state.contact_stored);
  visitor("contact_count", state.contact_count);
  visitor("deepest_penetration", state.deepest_penetration);
  visitor("deepest_birth", state.deepest_birth);
  visitor("ledger", state.ledger);
}

/// Every field as it stands, for the same build on the same kind of processor.
inline void put_state(ByteWriter& writer, const State& state) {
  visit_fields(state, [&writer](const char*, const auto& field) { writer.put(field); });
}
inline void take_state(ByteReader& reader, State& state) {
  visit_fields(state, [&reader](const char*, auto& field) { reader.take(field); });
}

}  // namespace cellcrush
