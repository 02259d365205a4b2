#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// A lattice of equal cells in words.
struct LatticeWords {
  std::string plural;       ///< "hexagons"
  std::string walls;        ///< what only this kind has to say of its walls: "along y 0.4 mm"; may be empty
  std::string theory_note;  ///< when not to compare it with theory, as sentences; empty where theory applies
};

/// Numbers may be missing. Empty for a kind that is not one of lattice_names().
LatticeWords words_of(const RegularLattice& lattice);

/// All kinds, in order: "hexagon" for lattice.hexagon.
std::vector<std::string> lattice_names();

}  // namespace cellcrush
