#pragma once

#include <span>
#include <string>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/state.h"
#include "contact/contact_sums.h"
#include "motion/integrate_motion.h"
#include "motion/motion_works.h"

namespace cellcrush {

class FieldChecker;

/// Motion of the impact plate over a step. It does not depend on the lattice, so it is known steps ahead.
struct PlateStep {
  double displacement = 0.0;  ///< mm, of the work of the forces: half a step before and half a step after them
  double travel = 0.0;        ///< mm, at the end of the step
  double speed = 0.0;         ///< mm/s, half a step before its end
  NearRange reach;            ///< positions between which no ball reaches a plate at its end
};
PlateStep plate_step_of(const Scene& scene, double time, double travel);

/// Particles of a band on which something presses.
struct PressedBand {
  const LatticeBand& band;
  std::span<const int> near_joints;  ///< that may be near a plate or rub on one, ascending
  std::span<const int> near_inner;
};

/// One kind of what presses on the walls from outside (E9c, E9f): rigid half planes that only push. A kind is one file
/// of this folder, which has its motion, its forces and its works. Functions act on all of a scene that is of the kind,
/// and do nothing where there is none.
struct Pusher {
  /// At time 0: places it, and makes room for its forces in the state.
  void (*place)(const Scene& scene, State& state);
  /// Moves what it has of speed from time 0 to half a step before, with the forces at time 0 (E2b). Null: nothing.
  void (*stagger)(const Scene& scene, State& state) = nullptr;
  /// Moves it over a step, from the forces at its start. Null: the state has nothing that moves before `accumulate`.
  /// Wavefronts do not call it (cut_into_bands).
  void (*move)(const Scene& scene, State& state) = nullptr;
  /// Adds its forces on the particles of a band at the end of the step to contact_force, friction_force and the sums.
  void (*press)(const Scene& scene, State& state, const PlateStep& plates, const PressedBand& on, ContactSums& sums);
  /// Accumulates the works and impulses of its forces at `time`, s, over the step from there on.
  void (*accumulate)(const Scene& scene, double time, const PlateStep& plates, State& state);
  /// The works of its newest forces over the half step up to the time of the state, and twice its kinetic energy.
  MotionWorks (*half_step_works)(const Scene& scene, const State& state);
  /// What is modelled, a sentence; empty if a scene has none.
  std::string (*words)(const Scene& scene);

  // Of kinds of half planes (LoadsSpec::RigidWall, push/half_planes.h); null for all others.

  /// Whether one is of the kind. The first kind that takes it has it.
  bool (*takes)(const LoadsSpec::RigidWall& wall) = nullptr;
  /// Checks the numbers that only the kind has; `path` ends with a dot.
  void (*check)(const std::string& path, const LoadsSpec::RigidWall& wall, FieldChecker& check) = nullptr;
  /// Fills in what the kind keeps of them.
  void (*fill)(const LoadsSpec::RigidWall& from, RigidWall& to) = nullptr;
};

/// All kinds, in the order in which they press and in which their works are added.
std::span<const Pusher* const> pushers();

/// The works of the force of a face over its mean displacement, mm (E10). What it exerts on particles is among the
/// contact forces.
MotionWorks face_works(const PlateForce& force, double displacement);

std::string friction_words(double coefficient);

}  // namespace cellcrush
