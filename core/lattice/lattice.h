#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "lattice/layout.h"

namespace cellcrush {

class FieldChecker;

/// Elements per wall of DRAFT, STANDARD and REFERENCE, and of what they are the meshes.
struct DefaultMesh {
  int draft = 0;
  int standard = 0;
  int reference = 0;
  std::string of_what;  ///< such as "hexagons crushed along y faster than 25 m/s"
};

/// A number that only one kind of lattice has.
struct OwnNumber {
  std::string_view name;  ///< as in the case
  double (*default_value)(const RegularLattice& lattice);
};

/// What one kind of lattice of equal cells answers. Each kind is a file of lattice/kinds, and a message of its name in
/// case.proto. Where a function gets a spec, it is one of a lattice of this kind; all but `check` REQUIRE a checked
/// one.
struct LatticeKind {
  std::string_view name;        ///< of the field of the case: lattice.NAME
  std::string_view plural;      ///< in sentences
  double walls_per_cell = 0.0;  ///< of a large lattice; the walls along its edges are additional
  /// Whether walls lie along the crush and are stacked, in either direction. Their contacts then limit the step.
  bool has_walls_along_crush = false;
  bool has_rows_of_cells = false;  ///< whether rows of cells can be stiff (lattice.inclusions)
  std::vector<OwnNumber> own_numbers = {};

  /// Checks the numbers of its own, and stiff rows. `side`: mm, endless if it is not valid. May be null.
  void (*check)(const SceneSpec& spec, double side, FieldChecker& check) = nullptr;
  /// Envelope in x and y, mm; its lower left corner is the origin.
  Vector2 (*envelope)(const SceneSpec& spec) = nullptr;
  /// Joints and walls. Every joint and wall is created once, joints in the order of their first use.
  Layout (*lay_out)(const SceneSpec& spec) = nullptr;
  /// Quasi-static plastic collapse stress of rigid, perfectly plastic walls, MPa.
  double (*collapse_stress)(const SceneSpec& spec) = nullptr;
  /// For force-based elements, at the direction and speed of the spec.
  DefaultMesh (*mesh)(const SceneSpec& spec) = nullptr;
  /// What its own numbers say of its walls, as in LatticeWords. Numbers may be missing. May be null.
  std::string (*walls_in_words)(const RegularLattice& lattice) = nullptr;
  /// When not to compare it with theory, as sentences; empty where theory applies.
  std::string theory_note = {};
};

/// All kinds, by name. CMake writes the list from the files of lattice/kinds: NAME.cpp defines NAME_lattice().
std::span<const LatticeKind* const> lattice_kinds();

/// The lattice of equal cells of a spec; null if it lists its walls, or has none.
const RegularLattice* regular_lattice_of(const SceneSpec& spec);

/// The kind of such a lattice. Null if the spec has none.
const LatticeKind* kind_of(const SceneSpec& spec);

bool has_walls_along_crush(const SceneSpec& spec);

/// Path of the fields of the lattice of a spec, such as "lattice.hexagon.".
std::string path_of_lattice(const SceneSpec& spec);

/// Fills in all numbers of its own.
void complete_own_numbers(RegularLattice& lattice);

/// The mesh of walls along the crush, which buckle in short waves.
DefaultMesh mesh_of_stacked_walls(std::string_view plural);

/// The theory note of a lattice whose walls yield axially.
std::string note_of_stretched_walls(const std::string& plural);

}  // namespace cellcrush
