#pragma once

#include <cstddef>
#include <memory>

#include "cellcrush/problem.h"
#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// The material of a spec in the plane of its lattice: what a fibre along the wall shows. In plane strain it is held
/// across: elastically E / (1 - nu^2); flowing, the stress along it is 2 / sqrt 3 of the effective stress and its
/// strain sqrt 3 / 2 of the effective one.
Material material_of(const MaterialSpec& spec);

/// 0: crushed along x, 1: along y.
int crush_axis_of(const SceneSpec& spec);

/// The spec with what its mesh does not depend on as by default: speed, strains, contact and plates, steps, output.
/// Specs that are equal in this part have the same mesh.
SceneSpec mesh_part_of(const SceneSpec& spec);

/// Mesh, masses and stable step. REQUIRES: a mesh part in which nothing spoils the mesh.
std::shared_ptr<Scene> build_mesh(const SceneSpec& part);

/// What the rest of a scene takes from its mesh. Units mm, tonne, s, MPa.
struct MeshMeasures {
  std::size_t particle_count = 0;
  std::size_t element_count = 0;
  double length = 0.0;  ///< envelope along the crush
  double stable_step = 0.0;
  double lightest_mass = 0.0;  ///< of a particle
  double shortest_element = 0.0;
  double thinnest_wall = 0.0;
  Material material;       ///< of the lattice
  bool hardening = false;  ///< of any material
  bool contact = false;    ///< whether walls touch each other
  Problems overlaps;       ///< walls that lie in each other before loading
};

/// Looks for walls that lie in each other too. REQUIRES: `scene` is the mesh of the part.
MeshMeasures measure_mesh(const SceneSpec& part, const Scene& scene);

/// The same of a mesh in which none do.
MeshMeasures measure_sound_mesh(const SceneSpec& part, const Scene& scene);

}  // namespace cellcrush
