#pragma once

#include <cstddef>

#include "scene/lattices.h"

namespace cellcrush {

/// Whether find_initial_overlaps (contact/initial_overlap.h) is bound to find nothing in a lattice whose joints are moved by
/// up to the amplitude in x and in y, however, and not to give up: true only where these bounds prove it. With the length L of
/// a wall, by how far u = sqrt(2) amplitude a point moves, the thickness T of the thickest wall, the least length l of an
/// element and the least angle theta between walls that meet:
///  - walls that meet nowhere stay D - 2 u apart, D being L in hexagons and squares and sqrt(3)/2 L in triangles: more than T;
///  - a ball and a segment of walls that meet, the ways p and q from their joint, are at least (p + q) sin(theta / 2) apart and
///    touch at 0.4 (p + q) at most; or at least l sin(theta), more than T;
///  - of one straight wall, ball and segment are as far apart as the way between them;
///  - by the same distances few balls are near a segment, and few points are in the buckets that are looked at.
/// REQUIRES: a checked lattice, in which T <= L / 2 and the amplitude is at most L / 10.
bool is_free_of_overlap(const RegularLattice& lattice, double thickest, double amplitude, std::size_t particles,
                        std::size_t elements);

}  // namespace cellcrush
