#pragma once

// A crush in the memory of a device: scene, state, and what the phases of a step pass to each other.

#include <cstddef>
#include <cstdint>

// clang-format off
#include "device/scene-inl.h"  // before any law: it has the names that these use
// clang-format on

#include "motion/integrate_motion.h"
#include "motion/motion_works-inl.h"
#include "motion/particle_motion-inl.h"
#include "push/push.h"
#include "simd/lane-inl.h"

namespace cellcrush::HWY_NAMESPACE {

using One = hn::CappedTag<double, 1>;

/// A force on a particle that is to be added to State::contact_force. The items of a phase add theirs in any order to a
/// list; the particle then adds them up by ascending key, which is the order on a processor.
struct AddedForce {
  enum Part : int { kBoth, kElastic, kViscous, kFriction };

  std::uint64_t key;
  int particle;
  int next;  ///< in the list of the particle; kEnd: none
  Part part;
  double value[4];  ///< elastic x and y, viscous x and y, or x and y of one of them

  static constexpr int kEnd = -1;
};

/// What a plate does to a ball.
struct PlatePush {
  FaceForce impact;
  FaceForce support;
};

/// What only a phase of one item writes, or all by operations without an order.
struct Totals {
  Ledger ledger;
  double impact_impulse;
  double support_impulse;
  double impact_travel;
  PlateForce impact_force;
  PlateForce support_force;
  ContactTotals contacts;
  double search_travel;               ///< mm by which gaps can have closed since the last search
  std::uint64_t greatest_velocity;    ///< bits of the greatest velocity of a particle over the step, squared
  std::uint64_t greatest_growth;      ///< bits of the greatest growth of half of a thickness in the step, mm
  std::uint64_t deepest_penetration;  ///< bits
  std::uint64_t deepest_birth;        ///< bits
  int added_forces;
  int searches;  ///< 1: contacts are searched in this step
  int overflow;  ///< 1: a list had no room
  int crossed;   ///< 1: walls have crossed
};

struct Crush {
  Scene scene;
  State state;
  StepFactors factors;
  Array<const ParticleRange> moved;    ///< chunks of particles that are moved together
  Array<const PlateStep> plate_steps;  ///< of the steps that are advanced at once
  Face impact;                         ///< at a travel of 0
  Face support;

  // The contact search: a grid of squares, each with a list of the segments whose middles it has. Squares share lists
  // where their numbers are alike.
  double square_size;        ///< mm
  Array<int> first_segment;  ///< of each list, a power of two of them; kEnd: none
  Array<int> next_segment;   ///< E
  // Where contacts are searched by faces (E8c), a ball touches segments of its own faces only. Otherwise empty.
  Array<const int> ball_faces_offset;  ///< N + 1
  Array<const int> ball_faces;
  Array<const int> segment_faces_offset;  ///< E + 1
  Array<const int> segment_faces;

  // Of every ball: kMostCandidates, kMostTouches.
  Array<int> candidate_count;
  Array<int> candidate;
  Array<int> touch_count;
  Array<int> touch_ball;
  Array<int> touch_segment;
  Array<double> touch_reach;
  Array<int> touch_linked;
  Array<int> touch_side;
  Array<double> touch_squared_depth;  ///< of a contact, with its share
  Array<double> touch_stored;         ///< that is counted twice, negative
  Array<int> active_count;
  // With friction alone. Of the touches now, their place before; of those before, in these places, what TouchMemory has
  // and whether the pair has friction in this step too.
  Array<int> touch_known;
  Array<int> touch_pushed;
  Array<double> touch_friction;
  Array<int> before_count;
  Array<int> before_segment;
  Array<int> before_pushed;
  Array<double> before_friction;
  Array<int> before_goes_on;
  Array<PlatePush> plate_push;
  Array<unsigned> pressed;  ///< a bit for each particle on which a plate pushes

  Array<const unsigned char> rule;  ///< RuleFactors of the kind of walls

  // Passed between the phases of a step.
  Array<AddedForce> added;
  Array<int> first_added;        ///< of each particle; AddedForce::kEnd: none
  Array<double> lane_works;      ///< kWorkTerms x kSumLanes x moved chunks, works of the particles of a lane
  Array<double> lane_plastic;    ///< kMostWallsInBlock x chunks of walls
  Array<float> single_scratch;   ///< kScratchKinds E
  Array<double> double_scratch;  ///< kScratchKinds E
  Array<Totals> totals;          ///< one
};

/// Changes with what a library for a device reads and writes.
inline constexpr std::size_t kLayout = sizeof(Crush) + 1000 * (sizeof(Totals) + 1000 * sizeof(AddedForce));

/// Contact, damping, friction, mass damping and external work.
inline constexpr std::size_t kWorkTerms = 5;

}  // namespace cellcrush::HWY_NAMESPACE
