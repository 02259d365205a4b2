#pragma once

// The phases of a step but for contacts. A phase is a number of items, each computed by a thread of its own. Items of a
// phase do not wait for each other, and none reads what another writes. Sums have the order of those on a processor.

#include <cstddef>

#include "beam/wall_chunk-inl.h"
#include "device/atomics-inl.h"
#include "device/crush-inl.h"
#include "motion/move_particles-inl.h"
#include "section/section_rule.h"

namespace cellcrush::HWY_NAMESPACE {

/// Notes the greatest velocity over the step.
struct VelocityNotes {
  double greatest_squared = 0.0;

  HWY_INLINE void note(const Points<One>&, std::size_t) const {}
};

/// Central differences for the particles of a lane of a chunk (motion/integrate_motion.cpp).
struct MoveParticles {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.moved.size() * kSumLanes; }

  static HWY_INLINE void compute(Crush& crush, std::size_t item, std::size_t /*step*/) {
    const ParticleRange range = crush.moved[item / kSumLanes];
    LaneWorks<One> works = WorkSums().load<One>(0);
    const std::size_t lane = item % kSumLanes;
    const bool is_damped = crush.scene.mass_damping > 0.0;
    if (crush.state.friction_force.empty()) {
      is_damped ? move_lane<ForceKinds<false, true, false>>(crush, range, lane, works)
                : move_lane<ForceKinds<false, false, false>>(crush, range, lane, works);
    } else {
      is_damped ? move_lane<ForceKinds<true, true, false>>(crush, range, lane, works)
                : move_lane<ForceKinds<true, false, false>>(crush, range, lane, works);
    }
    double* const to = &crush.lane_works[kWorkTerms * item];
    works.contact.store(to);
    works.contact_damping.store(to + 1);
    works.friction.store(to + 2);
    works.mass_damping.store(to + 3);
    works.external.store(to + 4);
  }

 private:
  template <class Kinds>
  static HWY_INLINE void move_lane(Crush& crush, const ParticleRange& range, std::size_t lane, LaneWorks<One>& works) {
    const ParticleArrays<State> arrays(crush.scene, crush.state);
    const VelocityNotes notes;
    double greatest = 0.0;
    for (std::size_t i = range.first + lane; i < range.end; i += kSumLanes) {
      ContactForce& force = crush.state.contact_force[i];
      if (force.elastic.x() != 0.0 || force.elastic.y() != 0.0 || force.viscous.x() != 0.0 ||
          force.viscous.y() != 0.0) {
        move<true, Kinds>(arrays, crush.factors, i, works, notes);
        force.elastic = Vector2(0.0, 0.0);
        force.viscous = Vector2(0.0, 0.0);
      } else {
        move<false, Kinds>(arrays, crush.factors, i, works, notes);
      }
      if constexpr (Kinds::kFriction) crush.state.friction_force[i] = Vector2(0.0, 0.0);
      const Vector2& velocity = crush.state.velocity[i];
      const double squared = velocity.x() * velocity.x() + velocity.y() * velocity.y();
      greatest = squared <= greatest ? greatest : squared;  // also where it is not a number
    }
    raise_at(crush.totals[0].greatest_velocity, greatest);
  }
};

/// The walls of a lane of a chunk (beam/wall_chunk-inl.h).
template <bool kForceBased, class Law, class Rule>
struct EvaluateWalls {
  using Factors = Rule;
  using T = typename Rule::Number;

  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.lane_plastic.size(); }

  static HWY_INLINE void compute(Crush& crush, const Rule& rule, std::size_t item) {
    const std::size_t chunk = item / kMostWallsInBlock;
    const int lane = static_cast<int>(item % kMostWallsInBlock);
    const Walls& walls = crush.scene.walls;
    const int first = walls.chunk_offset[chunk];
    const std::span<const WallBlock> blocks(&walls.blocks[first],
                                            static_cast<std::size_t>(walls.chunk_offset[chunk + 1] - first));
    WallChunk<kForceBased, Law, Rule, One, hn::CappedTag<T, 1>> of_chunk(
        crush.scene, crush.state, memory_of(crush), crush.factors.step, rule, blocks,
        scratch_of(crush) + kScratchKinds * static_cast<std::size_t>(blocks.front().first_element));
    double work = 0.0;
    for (const WallBlock& block : blocks) {
      if (lane < block.walls) of_chunk.advance_alone(block, lane, &work);
    }
    crush.lane_plastic[item] = work;
    if (!crush.state.thickening.empty()) raise_at(crush.totals[0].greatest_growth, of_chunk.thickening_step());
  }

 private:
  static HWY_INLINE FibreHistory<T>& memory_of(Crush& crush) {
    if constexpr (sizeof(T) == sizeof(float)) {
      return crush.state.single_fibres;
    } else {
      return crush.state.fibres;
    }
  }
  static HWY_INLINE T* scratch_of(Crush& crush) {
    if constexpr (sizeof(T) == sizeof(float)) {
      return crush.single_scratch.data();
    } else {
      return crush.double_scratch.data();
    }
  }
};

template <class Kind>
HWY_INLINE const typename Kind::Factors& rule_of(const Crush& crush) {
  return *reinterpret_cast<const typename Kind::Factors*>(crush.rule.data());
}

/// The forces of walls on a joint (sum_joint_forces of beam/internal_forces.h).
struct SumJoints {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.scene.wall_end_offset.size() - 1; }

  static HWY_INLINE void compute(Crush& crush, std::size_t joint, std::size_t /*step*/) {
    const int first = crush.scene.wall_end_offset[joint];
    const int end = crush.scene.wall_end_offset[joint + 1];
    const bool of_three = end - first == 3;
    Points<One> force = {0, 0};
    Lane<One> moment = 0;
    for (int k = first; k < end; ++k) {
      const int from = crush.scene.wall_ends[k];
      const Points<One> of_wall = Points<One>::load(&crush.state.wall_force[from]);
      const Lane<One> of_moment = Lane<One>::load(&crush.state.wall_moment[from]);
      const bool begins = of_three && k == first;
      force = begins ? of_wall : force + of_wall;
      moment = begins ? of_moment : moment + of_moment;
    }
    force.store(&crush.state.internal_force[joint]);
    moment.store(&crush.state.internal_moment[joint]);
  }
};

/// Adds the works of the motion to the ledger and decides whether contacts are searched in this step: as soon as
/// particles can have approached each other by the skin of the lists.
struct AddMotion {
  static HWY_INLINE std::size_t items(const Crush& /*crush*/) { return 1; }

  static HWY_INLINE void compute(Crush& crush, std::size_t /*item*/, std::size_t step) {
    Totals& totals = crush.totals[0];
    for (std::size_t chunk = 0; chunk < crush.moved.size(); ++chunk) {
      works_of(crush, chunk).accumulate(totals.ledger);
    }
    const PlateStep& plates = crush.plate_steps[step];
    face_works(totals.impact_force, plates.displacement).accumulate(totals.ledger);
    const double dt = crush.factors.step;
    totals.impact_impulse += dt * (totals.impact_force.elastic + totals.impact_force.viscous);
    totals.support_impulse += dt * (totals.support_force.elastic + totals.support_force.viscous);
    totals.impact_travel = plates.travel;
    for (std::size_t chunk = 0; chunk < crush.lane_plastic.size() / kMostWallsInBlock; ++chunk) {
      double plastic = 0.0;
      for (std::size_t lane = 0; lane < kMostWallsInBlock; ++lane) {
        plastic += crush.lane_plastic[chunk * kMostWallsInBlock + lane];
      }
      totals.ledger.plastic += plastic;
    }
    const double velocity = std::sqrt(std::bit_cast<double>(totals.greatest_velocity));
    totals.search_travel += 2.0 * (dt * velocity + std::bit_cast<double>(totals.greatest_growth));
    totals.searches = totals.search_travel < crush.scene.contact.face_skin ? 0 : 1;
    totals.search_travel = totals.searches != 0 ? 0.0 : totals.search_travel;
    totals.greatest_velocity = 0;
    totals.greatest_growth = 0;
    totals.added_forces = 0;
    for (std::size_t word = 0; word < crush.pressed.size(); ++word) crush.pressed[word] = 0;
  }

 private:
  static HWY_INLINE MotionWorks works_of(const Crush& crush, std::size_t chunk) {
    double sums[kWorkTerms] = {};
    for (std::size_t lane = 0; lane < kSumLanes; ++lane) {
      for (std::size_t term = 0; term < kWorkTerms; ++term) {
        sums[term] += crush.lane_works[(chunk * kSumLanes + lane) * kWorkTerms + term];
      }
    }
    return {sums[0], sums[1], sums[2], sums[3], sums[4]};
  }
};

}  // namespace cellcrush::HWY_NAMESPACE
