#pragma once

#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

// Textbook problems in which axial force and moment act together on a perfectly plastic rectangle, of section and
// material of PlasticFrame (scenes/textbook.h). Its interaction is exact: M = M_p (1 - n^2), n = N / N_p.

/// Root moment over M_p of a cantilever that is pulled by n N_p and then pushed aside by a tenth of its length: the
/// mean over the last quarter of the way, with the moments of both tip forces about the root in the deformed shape.
double root_moment_of_pulled_cantilever(double n, int elements, SectionSpec::AreaRule area);

/// Axial force over N_p of a clamped strut that its end folds, when its middle has moved aside by each of `deflections`
/// times its thickness, ascending. Three hinges, rigid-plastic: n = sqrt(1 + (w / h)^2) - w / h.
std::vector<double> forces_of_folded_strut(int elements, const std::vector<double>& deflections);

/// Load over 8 M_p / L of a beam of two members that is clamped at both ends, held along its axis, and pushed at its
/// middle, at each of `deflections` over thickness, ascending. `stiffening`: factor of Young's
/// modulus. Rigid-plastic: 1 + (W / h)^2 up to W = h, then 2 W / h.
std::vector<double> loads_of_held_beam(int elements, double stiffening, const std::vector<double>& deflections);

}  // namespace cellcrush::scenes
