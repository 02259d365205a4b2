#pragma once

// A crush in the memory of a device, and the phases of its steps. A phase is a number of items, each computed by a
// thread of its own; items of a phase do not wait for each other, and what one writes no other reads. All sums have the
// order of those on a processor, so the bits are the same.

#include <cstddef>
#include <cstdint>

#include "beam/wall_chunk-inl.h"
#include "device/scene-inl.h"
#include "motion/integrate_motion.h"
#include "motion/move_particles-inl.h"
#include "push/push.h"
#include "section/section_rule.h"

namespace cellcrush::HWY_NAMESPACE {

using One = hn::CappedTag<double, 1>;

/// What a plate does to a particle.
struct PlatePush {
  PlateForce impact;
  PlateForce support;
};

/// What changes with every step, and only one item of a phase writes.
struct Totals {
  Ledger ledger;
  double impact_impulse;
  double support_impulse;
  double impact_travel;
  PlateForce impact_force;
  PlateForce support_force;
};

struct Crush {
  Scene scene;
  State state;
  StepFactors factors;
  Array<const ParticleRange> moved;   ///< chunks of particles that are moved together
  Array<const PlateStep> plate_steps; ///< of the steps that are advanced at once
  double impact_face;
  double support_face;

  // Passed between the phases of a step.
  Array<double> lane_works;      ///< 6 x kSumLanes x moved chunks, works of the particles of a lane
  Array<double> lane_plastic;    ///< kMostWallsInBlock x chunks of walls
  Array<float> single_scratch;   ///< kScratchKinds E
  Array<double> double_scratch;  ///< kScratchKinds E
  Array<Totals> totals;          ///< one
};

/// Where a particle is after the step matters to none but itself.
struct NoNotes {
  HWY_INLINE void note(const Points<One>&, std::size_t) const {}
};

struct MoveParticles {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.moved.size() * kSumLanes; }

  static HWY_INLINE void compute(const Crush& crush, std::size_t item, std::size_t /*step*/) {
    const ParticleRange& range = crush.moved[item / kSumLanes];
    const ParticleArrays<State> arrays(crush.scene, const_cast<State&>(crush.state));
    LaneWorks<One> works = WorkSums().load<One>(0);
    if (crush.scene.mass_damping > 0.0) {
      move_lane<ForceKinds<false, true, false>>(crush, arrays, range, item % kSumLanes, works);
    } else {
      move_lane<ForceKinds<false, false, false>>(crush, arrays, range, item % kSumLanes, works);
    }
    double* const to = &crush.lane_works[6 * item];
    works.contact.store(to);
    works.contact_damping.store(to + 1);
    works.friction.store(to + 2);
    works.mass_damping.store(to + 3);
    works.external.store(to + 4);
  }

 private:
  template <class Kinds>
  static HWY_INLINE void move_lane(const Crush& crush, const ParticleArrays<State>& arrays, const ParticleRange& range,
                                   std::size_t lane, LaneWorks<One>& works) {
    NoNotes notes;
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
    }
  }
};

template <bool kForceBased, class Law, class Rule>
struct EvaluateWalls {
  using T = typename Rule::Number;

  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.lane_plastic.size(); }

  static HWY_INLINE void compute(const Crush& crush, const Rule& rule, std::size_t item, std::size_t /*step*/) {
    const std::size_t chunk = item / kMostWallsInBlock;
    const int lane = static_cast<int>(item % kMostWallsInBlock);
    const Walls& walls = crush.scene.walls;
    const int first = walls.chunk_offset[chunk];
    const std::span<const WallBlock> blocks(&walls.blocks[first],
                                            static_cast<std::size_t>(walls.chunk_offset[chunk + 1] - first));
    State& state = const_cast<State&>(crush.state);
    FibreHistory<T>* memory = nullptr;
    T* scratch = nullptr;
    if constexpr (sizeof(T) == sizeof(float)) {
      memory = &state.single_fibres;
      scratch = crush.single_scratch.data();
    } else {
      memory = &state.fibres;
      scratch = crush.double_scratch.data();
    }
    WallChunk<kForceBased, Law, Rule, One, hn::CappedTag<T, 1>> of_chunk(
        crush.scene, state, *memory, crush.factors.step, rule, blocks,
        scratch + kScratchKinds * blocks.front().first_element);
    double work = 0.0;
    for (const WallBlock& block : blocks) {
      if (lane < block.walls) of_chunk.advance_alone(block, lane, &work);
    }
    crush.lane_plastic[item] = work;
  }
};

struct SumJoints {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.scene.wall_end_offset.size() - 1; }

  static HWY_INLINE void compute(const Crush& crush, std::size_t joint, std::size_t /*step*/) {
    const int first = crush.scene.wall_end_offset[joint];
    const int end = crush.scene.wall_end_offset[joint + 1];
    Points<One> force = {0, 0};
    Lane<One> moment = 0;
    for (int k = first; k < end; ++k) {
      const int from = crush.scene.wall_ends[k];
      const Points<One> of_wall = Points<One>::load(&crush.state.wall_force[from]);
      const Lane<One> of_moment = Lane<One>::load(&crush.state.wall_moment[from]);
      force = k == first ? of_wall : force + of_wall;
      moment = k == first ? of_moment : moment + of_moment;
    }
    force.store(&crush.state.internal_force[joint]);
    moment.store(&crush.state.internal_moment[joint]);
  }
};

}  // namespace cellcrush::HWY_NAMESPACE
