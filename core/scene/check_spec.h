#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "fields/field_checker.h"

namespace cellcrush {

/// All problems of a spec that can be found without building its mesh, in the order of the fields. This is the only
/// validator of the physics: build_scene can build whatever it accepts.
/// REQUIRES: the fidelity has been filled in.
Problems check_spec(const SceneSpec& spec);

/// Most elements of a mesh: what a machine of 2 GB holds with room to spare.
inline constexpr double kMostElements = 2e6;

/// Approximate number of elements of the mesh of a spec, without building it. For a frame or a network it is exact. For
/// a regular lattice it omits the walls along the edges, and rigid walls have fewer. REQUIRES: beams, or columns and
/// rows.
double count_elements(const SceneSpec& spec);

/// Checks a material; `path` ends with a dot.
void check_material(const std::string& path, const MaterialSpec& material, FieldChecker& check);

/// Checks the section rule, contact, and whether what they ask for goes together.
void check_section_and_contact(const SceneSpec& spec, FieldChecker& check);

/// Checks the frame of a spec and the loads on its nodes and beams: nodes that exist, beams of some length, times in
/// order.
void check_frame(const SceneSpec& spec, FieldChecker& check);

/// Checks the lists of a network: joints that exist, walls of some length, entries that fit the walls.
void check_network(const SceneSpec& spec, FieldChecker& check);

/// Checks the numbers of a Voronoi honeycomb. Returns the side, mm; an endless one if it is not valid.
double check_voronoi(const SceneSpec& spec, FieldChecker& check);

/// Checks the changes of a lattice.
void check_changes(const SceneSpec& spec, FieldChecker& check);

/// The least distance of two joints that a wall of a network connects, mm; endless where none is sound.
double shortest_wall_of(const NetworkWalls& network);

/// Problems of walls whose mid-lines cross or touch before loading without a joint: contact cannot know their sides.
/// Names the walls and the position. Walls that only overlap are no problem; they are written to `touching`. REQUIRES:
/// the mesh of the spec, as for the search.
Problems check_crossings(const SceneSpec& spec, const Scene& scene, StartOverlaps& touching);

}  // namespace cellcrush
