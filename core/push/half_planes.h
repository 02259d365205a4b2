#pragma once

#include "cellcrush/scene_spec.h"
#include "fields/field_checker.h"
#include "push/push.h"

namespace cellcrush {

/// What a rigid wall finds.
struct WallRoom {
  Vector2 gravity = Vector2::Zero();  ///< mm/s^2
  double area = 0.0;                  ///< mm^2, of the lattice before loading, along the edge at which it stands
};

/// One kind of half plane (LoadsSpec::RigidWall): how it moves along its normal, and the numbers of its own. A kind is
/// one file of this folder; half_planes.cpp has the list.
struct HalfPlaneKind {
  std::string_view plural;  ///< at the start of a sentence
  /// Whether it is of the kind. The first kind that takes it has it.
  bool (*takes)(const LoadsSpec::RigidWall& wall);
  /// Names of the fields that the kind has of those in LoadsSpec::RigidWall::own and functions, and what is said of
  /// another one.
  std::span<const std::string_view> fields;
  std::string_view misfit;
  std::string_view remedy;
  /// Checks what the fields have to do with each other; `path` ends with a dot. Null: nothing.
  void (*check)(const std::string& path, const SceneSpec& spec, const LoadsSpec::RigidWall& wall, FieldChecker& check);
  /// Fills in what the kind keeps of its fields. Null: nothing.
  void (*fill)(const LoadsSpec::RigidWall& from, const WallRoom& room, RigidWall& to);
  RigidWallMotion (*start)(const Scene& scene, const RigidWall& wall);
  /// Its motion at the end of the coming step, from the newest forces.
  RigidWallMotion (*move)(const Scene& scene, const State& state, std::size_t wall);
  /// Of one with a mass: its acceleration along the normal at a time by all but the lattice, mm/s^2, whose work is
  /// external.
  double (*drive)(const Scene& scene, const RigidWall& wall, double time) = nullptr;
  std::string_view note = {};  ///< what to know of it, after a space
};

/// Of a half plane with a mass, by the newest forces, mm/s^2 along its normal (E9g).
double acceleration_of(const Scene& scene, const State& state, std::size_t wall);

/// Checks those of a spec: normals with a direction, motions with times in order, and what their kinds ask for.
void check_half_planes(const SceneSpec& spec, FieldChecker& check);

/// Adds those of checked loads to the scene. `extent`: of the envelope of its lattice along x and y, mm. REQUIRES: the
/// radii of the particles, if it has any.
void attach_half_planes(const LoadsSpec& loads, const Vector2& extent, Scene& scene);

/// Direction out of a wall at an edge of the lattice, towards it.
Vector2 normal_at(LoadsSpec::Edge edge);

/// Of the surfaces of the walls before loading, the least place along a direction, mm; -1 without particles.
double outermost_along(const Scene& scene, const Vector2& direction);

/// Adds the two side walls of a loading, if it has any (E9h): the lower one, then the upper one. REQUIRES: the radii of
/// the particles.
void attach_side_walls(const LoadingSpec& loading, Scene& scene);

/// Both side walls; empty without any.
std::span<const RigidWall> side_walls_of(const Scene& scene);

/// Problems of walls that stand in a half plane at time 0 (E9f). The first `nodes` particles are nodes of a frame.
Problems find_walls_in_half_planes(const Scene& scene, std::size_t nodes);

std::string friction_words(double coefficient, const std::string& before = "");

}  // namespace cellcrush
