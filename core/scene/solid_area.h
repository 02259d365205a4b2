#pragma once

#include <optional>
#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Solid fraction between the plates from which a result depends on the mesh and on the stiffness of contacts: a stack
/// of walls has no gap left somewhere. Up to it, meshes of four and more elements a wall agree.
inline constexpr double kClosed = 0.75;

/// Area that walls fill before loading, mm^2: length times thickness of all elements, where neighbouring walls of a
/// joint overlap counted once. Of two walls at an angle f < pi with thicknesses g and h that is
///   (g h / 2 + (g^2 + h^2) / 4 cos f) / (2 sin f),
/// h^2/4 cot(f/2) for even walls. Cells of rigid bodies cannot close: they count as solid.
double solid_area_of(const Scene& scene);

/// Solid area over that between the plates at a nominal strain. REQUIRES: an envelope.
double solid_fraction_at(const Scene& scene, double strain);

/// Nominal strain at which an envelope is closed, 1 - solid area / (kClosed envelope); 0 if it is before loading.
double closing_strain_of(double solid_area, double envelope);

/// That of a scene; nothing without plates, and of a frame that fills its envelope, as a column does.
std::optional<double> closing_strain_of(const Scene& scene);

/// Whether a strain is past that one by more than a step, in which a run that ends there takes its last sample.
bool is_past_closing(const Scene& scene, double strain);

/// Solid area over that between two rigid walls that face each other, as wide as the particles are along them and no
/// deeper than they are across; of several such pairs the greatest. 0 without one. No motions: those before loading.
double solid_fraction_between_walls(const Scene& scene, std::span<const Vector2> position,
                                    std::span<const RigidWallMotion> motions);

}  // namespace cellcrush
