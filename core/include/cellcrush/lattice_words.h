#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// A lattice of equal cells in words.
struct LatticeWords {
  std::string plural;       ///< "hexagons"
  std::string walls;        ///< numbers that only this kind has, as "vertical wall thickness 0.4 mm"; may be empty
  std::string theory_note;  ///< when not to compare it with theory, as sentences; empty where theory applies
};

/// Numbers may be missing. Empty for a kind that is not one of lattice_names().
LatticeWords words_of(const RegularLattice& lattice);

/// The lattice with the defaults of all numbers that only its kind has. REQUIRES: a checked one.
RegularLattice with_own_numbers(RegularLattice lattice);

/// All kinds, in order: "hexagon" for lattice.hexagon.
std::vector<std::string> lattice_names();

}  // namespace cellcrush
