#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// The face of a rigid half plane at the current time: of a plate or of a rigid wall.
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

}  // namespace cellcrush
