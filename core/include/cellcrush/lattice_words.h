#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// When not to compare the lattice of a spec with theory, as sentences; empty where theory applies.
std::string theory_note_of(const SceneSpec& spec);

/// A kind of lattice of equal cells, as in the case and in sentences.
struct LatticeName {
  std::string name;    ///< "hexagon": lattice.hexagon
  std::string plural;  ///< "hexagons"
};

/// All kinds, by name.
std::vector<LatticeName> lattice_names();

}  // namespace cellcrush
