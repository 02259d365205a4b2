#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/slowest_wall.h"
#include "scene/time_step.h"

namespace cellcrush {

/// The material of a spec in the plane of its lattice, as seen by a fibre along the wall. In plane strain the wall is
/// held across (E6b): the elastic modulus is E / (1 - nu^2). In plastic flow, of a strip too, the stress along the wall
/// is 2 / sqrt 3 of the effective stress, and its strain sqrt 3 / 2 of the effective strain.
Material material_of(const MaterialSpec& spec);

/// That of the spec, then those of its walls, in their order.
std::vector<MaterialSpec> material_specs_of(const SceneSpec& spec);

/// 0: crushed along x, 1: along y.
int crush_axis_of(const SceneSpec& spec);

/// Whether the walls stand between two plates.
bool has_plates(const SceneSpec& spec);

/// Whether the plates alone move the walls, so that nothing approaches faster than they do.
bool is_driven_by_plates_alone(const SceneSpec& spec);

/// The spec with defaults in all fields on which its mesh does not depend: speed, ends, contact and plates, steps,
/// output. Specs that are equal in this part have the same mesh.
SceneSpec mesh_part_of(const SceneSpec& spec);

/// Builds the mesh, masses and stable step. REQUIRES: a mesh part without problems that prevent meshing.
std::shared_ptr<Scene> build_mesh(const SceneSpec& part);

/// Measures of a mesh on which the rest of a scene depends. Units mm, tonne, s, MPa.
struct MeshMeasures {
  std::size_t element_count = 0;
  double length = 0.0;            ///< envelope of the joints along the crush
  double width = 0.0;             ///< and across it
  double solid_area = 0.0;        ///< that can close: 0 of listed walls that fill their envelope, as a column does
  double relative_density = 0.0;  ///< real mass over that of the solid envelope
  double closing_strain = 0.0;    ///< between plates (scene/solid_area.h)
  MeshSteps steps;
  double lightest_mass = 0.0;  ///< of a particle
  double shortest_element = 0.0;
  double thinnest_wall = 0.0;
  double approach_speed = 0.0;  ///< mm/s, of what loads, motions and rigid walls move (E9a)
  SlowestWall slowest_wall;
  Material material;               ///< of the lattice
  bool contact = false;            ///< whether walls touch each other
  bool rigid_walls = false;        ///< whether there are rigid walls
  bool walls_along_crush = false;  ///< has_walls_along_crush
  /// Largest strain of a wall's fibres over the nominal strain, while the lattice is elastic.
  double bending_share = 1.0;
  /// Mass of as many particles as there are, each the lightest, over that of the lightest rigid wall with a mass.
  double pressed_share = 0.0;
  /// Walls that cross each other, or stand in a rigid wall, before loading; grips that hold nothing of their own.
  Problems misplaced;
  StartOverlaps start_overlaps;  ///< empty without contact
};

/// Measures a mesh, and searches for walls that cross or overlap. REQUIRES: `scene` is the mesh of the part.
MeshMeasures measure_mesh(const SceneSpec& part, const Scene& scene);

/// The same for a mesh of which it is known that nothing crosses; without the overlaps.
MeshMeasures measure_sound_mesh(const SceneSpec& part, const Scene& scene);

}  // namespace cellcrush
