#pragma once

#include <optional>

#include "cellcrush/scene.h"

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

/// Nominal strain at which a lattice between plates is closed, 1 - solid area / (kClosed envelope); nothing without an
/// envelope, as of a frame. At most 0 if it is closed before loading.
std::optional<double> closing_strain_of(const Scene& scene);

/// Whether a strain is past that one by more than a step, in which a run that ends there takes its last sample.
/// REQUIRES: plates.
bool is_past_closing(const Scene& scene, double strain);

}  // namespace cellcrush
