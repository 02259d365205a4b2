#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Fraction of its extent L by which a lattice without plates is shortened at the end of its run, an estimate from 0 to
/// 1: the greater of what is imposed and what is driven,
///   min(1, (v + sqrt(max(0, W - D) / m)) T / L, K / max(0, D - W)).
/// Imposed are motions of nodes, and of rigid walls from where they meet the lattice; a rotation counts by its share of
/// pi. T is the time of the run; v is the greatest difference of the initial velocities, those of masses shared with
/// half of the lattice, which they take along. m is the mass of the lattice, K the kinetic energy at the start, W the
/// work of gravity and of the greatest loads over the extent. D is the work that folds all walls: at both ends the
/// plastic moment of the wall over a radian, or the elastic moment that turns its end by half a radian if that is less.
double shortening_of(const Scene& scene);

}  // namespace cellcrush
