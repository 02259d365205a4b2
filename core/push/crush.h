#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// Strain and forces of a crush: between plates, or between two rigid walls in their place (CrushingWalls).

/// The two walls of a scene without plates; nothing if more or fewer pairs qualify.
std::optional<CrushingWalls> find_crushing_walls(const Scene& scene);

/// Sets the walls that crush a scene, with the extent of its particles along and across their normals as the envelope.
/// A straight column is as wide as it is thick. REQUIRES: the radii of the particles.
void put_crushing_walls(Scene& scene);

/// Whether it is crushed in this sense.
inline bool is_crushed(const Scene& scene) { return scene.plates.present || scene.crushing_walls.has_value(); }

/// Whether it is crushed against something. Without a support only one wall presses: a striker on a free lattice, or
/// the wall that a lattice is thrown at.
bool has_support(const Scene& scene);

/// Unit vector in which the impact plate moves, or the direction out of an only wall. REQUIRES: is_crushed().
Vector2 crush_direction_of(const Scene& scene);

/// The axis nearest to it, 0: x, 1: y.
int crush_axis_of(const Scene& scene);

/// Greatest speed of the impact plate, mm/s; of a mass, that of its start, or the mean of a crush to the end if that is
/// more. REQUIRES: is_crushed().
double crush_speed_of(const Scene& scene);

/// By how much the plates have come together since they touch the lattice, or the lattice is shorter without a support,
/// mm. 0 unless is_crushed().
double crush_travel_of(const Scene& scene, const State& state);

/// That over the undeformed length.
double crush_strain_of(const Scene& scene, const State& state);

/// Of the impact plate, and the grips that are fixed to it, on the lattice since the start, N s along the crush.
/// REQUIRES: is_crushed(), as below.
double impact_impulse_of(const Scene& scene, const State& state);

/// Of the support plate and the grips that are fixed to it, N s against the crush; 0 without a support.
double support_impulse_of(const Scene& scene, const State& state);

}  // namespace cellcrush
