#pragma once

#include <span>
#include <string>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "motion/integrate_motion.h"
#include "motion/motion_works.h"
#include "motion/plate_motion.h"

namespace cellcrush {

/// Motion of the impact plate over a step. It does not depend on the lattice, so it is known steps ahead; if its speed
/// is controlled, up to the next setting.
struct PlateStep {
  double displacement = 0.0;  ///< mm, of the work of the forces: half a step before and half a step after them
  double travel = 0.0;        ///< mm, at the end of the step
  double speed = 0.0;         ///< mm/s, half a step before its end
  NearRange reach;            ///< positions between which no ball reaches a plate at its end
};
PlateStep plate_step_of(const Scene& scene, const State& state, double time, double travel);

/// Particles of a band on which something presses.
struct PressedBand {
  const LatticeBand& band;
  std::span<const int> near_joints;  ///< that may be near a plate or rub on one, ascending
  std::span<const int> near_inner;
};

/// What presses on the walls from outside by rigid faces that only push (E9c, E9f): its motion, its forces and its
/// works. The functions act on all of a scene that is of the kind, and do nothing where there is none. Half planes of
/// every kind are one pusher (push/half_planes.h).
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
  /// Accumulates the works and impulses of the forces at the start of the step over the step.
  void (*accumulate)(const Scene& scene, const PlateStep& plates, State& state);
  /// The works of its newest forces over the half step up to the time of the state, and twice its kinetic energy.
  MotionWorks (*half_step_works)(const Scene& scene, const State& state);
  /// Adds what is modelled, in sentences.
  void (*describe)(const Scene& scene, std::vector<std::string>& lines);
};

/// All of them, in the order in which they press and in which their works are added.
std::span<const Pusher* const> pushers();

/// The face of a rigid half plane at the current time.
struct Face {
  Vector2 point;        ///< on the face, mm
  Vector2 normal;       ///< unit, out of the half plane
  Vector2 tangent;      ///< unit, perpendicular to the normal: positive direction of friction
  double speed;         ///< along the normal, mm/s, half a step before
  double stiffness;     ///< k, N/mm, of one particle
  double friction;      ///< Coulomb's coefficient
  double* friction_of;  ///< friction of each particle along the tangent, N; null without friction
  bool grows;           ///< balls may have grown (E5f)

  /// Of the centre of a ball, mm.
  [[nodiscard]] double distance_of(const Vector2& place) const { return normal.dot(place - point); }
};

/// A plate at `place` mm along the crush, on the side of the lattice to which `outward` points, +1 or -1 along it.
/// `friction_of`: as in Face.
Face face_of_plate(const Scene& scene, double place, double outward, double velocity, double* friction_of, bool grows);

/// What a face does to one particle.
struct FaceForce {
  double elastic = 0.0;     ///< N along the normal
  double viscous = 0.0;     ///< N along the normal
  double tangential = 0.0;  ///< N along the tangent
  double stored = 0.0;      ///< N mm, stored energy
};

/// Pushes a particle whose ball of `radius` mm overlaps the face, by the penalty law of the walls (E9c), and adds the
/// forces to contact_force. Friction acts along the tangent on the surface of the ball (E9d, E9e); it is added to
/// friction_force, also of the particles beside it. Faces move along their normals only, so the slip is the motion of
/// the ball's surface. Forces of a ball that has left are 0.
FaceForce push_by_face(const Scene& scene, State& state, const Face& face, int particle, double radius);

/// The works of the force of a face over its mean displacement, mm (E10). What it exerts on particles is among the
/// contact forces.
constexpr MotionWorks face_works(const PlateForce& force, double displacement) {
  return {.contact = force.elastic * displacement,
          .contact_damping = force.viscous * displacement,
          .external = (force.elastic + force.viscous) * displacement};
}

}  // namespace cellcrush
