#pragma once

#include "cellcrush/scene_spec.h"
#include "fields/field_checker.h"
#include "push/push.h"

namespace cellcrush {

/// One kind of half plane (LoadsSpec::RigidWall): how it moves along its normal, and the numbers of its own. A kind is
/// one file of this folder; half_planes.cpp has the list.
struct HalfPlaneKind {
  std::string_view plural;  ///< at the start of a sentence
  /// Whether it is of the kind. The first kind that takes it has it.
  bool (*takes)(const LoadsSpec::RigidWall& wall);
  /// Checks the numbers that only the kind has; `path` ends with a dot.
  void (*check)(const std::string& path, const LoadsSpec::RigidWall& wall, FieldChecker& check);
  /// Fills in what the kind keeps of them. Null: nothing.
  void (*fill)(const LoadsSpec::RigidWall& from, RigidWall& to);
  RigidWallMotion (*start)(const Scene& scene, const RigidWall& wall);
  /// Its motion at the end of the coming step, from the newest forces.
  RigidWallMotion (*move)(const Scene& scene, const State& state, std::size_t wall);
  /// Of one with a mass: its acceleration along the normal by all but the lattice, mm/s^2, whose work is external.
  double (*drive)(const Scene& scene, const RigidWall& wall, const RigidWallMotion& motion) = nullptr;
  std::string_view note = {};  ///< what to know of it, after a space
};

/// Of a half plane with a mass, by the newest forces, mm/s^2 along its normal (E9g).
double acceleration_of(const Scene& scene, const State& state, std::size_t wall);

/// Checks those of a spec: normals with a direction, motions with times in order, and what their kinds ask for.
void check_half_planes(const LoadsSpec& loads, FieldChecker& check);

/// Adds those of a checked spec to the scene.
void attach_half_planes(const LoadsSpec& loads, Scene& scene);

/// Adds the two side walls of a loading, if it has any (E9h): the lower one, then the upper one. REQUIRES: the radii of
/// the particles.
void attach_side_walls(const LoadingSpec& loading, Scene& scene);

/// Both side walls; empty without any.
std::span<const RigidWall> side_walls_of(const Scene& scene);

/// Problems of walls that stand in a half plane at time 0 (E9f). The first `nodes` particles are nodes of a frame.
Problems find_walls_in_half_planes(const Scene& scene, std::size_t nodes);

std::string friction_words(double coefficient, const std::string& before = "");

}  // namespace cellcrush
