#pragma once

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A rigid wall at an edge of the lattice, which stands still until it is given more.
LoadsSpec::RigidWall wall_at(LoadsSpec::Edge edge);

/// The same with a mass.
LoadsSpec::RigidWall striker_at(LoadsSpec::Edge edge, double mass_g, double speed_m_per_s);

// The presets of experiments.
SceneSpec struck_block();
SceneSpec thrown_block();
SceneSpec pressure_pulse();
SceneSpec dropped_weight();
SceneSpec loaded_and_unloaded();
SceneSpec brittle_lattice();

// The presets of laws and of thick walls.
SceneSpec tension_test();
SceneSpec voce_hardening();
SceneSpec thick_hexagons();
SceneSpec measured_ring();

}  // namespace cellcrush::scenes
