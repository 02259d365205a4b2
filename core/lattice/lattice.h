#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

class FieldChecker;

/// Elements per wall of DRAFT, STANDARD and REFERENCE, and of what they are the meshes.
struct DefaultMesh {
  int draft = 0;
  int standard = 0;
  int reference = 0;
  std::string of_what;  ///< such as "hexagons with walls along the crush, faster than 25 m/s"
};

/// A number that only one kind of lattice has.
struct OwnNumber {
  std::string_view name;                                   ///< as in the case
  double (*default_value)(const RegularLattice& lattice);  ///< other numbers may be missing
  double most_of_side = 0.0;  ///< its upper limit over side_mm; 0: its limits are those of its field in case.proto
};

/// Closed forms of an endless lattice, crushed along one axis, over the numbers of the wall: a modulus over E, a stress
/// over sigma_y. The moduli are those of Euler-Bernoulli beams.
struct ClosedForms {
  double density = 0.0;  ///< walls counted from joint to joint
  double modulus = 0.0;
  double poissons_ratio = 0.0;                 ///< of the strain across the crush
  std::optional<double> collapse_stress = {};  ///< quasi-static, of slender, rigid, perfectly plastic walls
};

/// What one kind of lattice of equal cells answers. Each kind is a file of lattice/kinds, and a message of its name in
/// case.proto. Where a function gets a lattice or a spec, it is one of this kind; all but `check` REQUIRE a checked
/// one.
struct LatticeKind {
  std::string_view name;        ///< of the field of the case: lattice.NAME
  std::string_view plural;      ///< in sentences
  double walls_per_cell = 0.0;  ///< of a large lattice; the walls along its edges are additional
  /// Whether walls lie along the crush and are stacked, in either direction. Their contacts then limit the step.
  bool has_walls_along_crush = false;
  double step_cost = 1.0;          ///< time of an element-step over that of hexagons (scene/run_cost.h)
  bool has_rows_of_cells = false;  ///< whether rows of cells can be stiff (lattice.inclusions)
  std::vector<OwnNumber> own_numbers = {};

  /// Checks how its own numbers fit together, which are within their limits, and stiff rows. `side`: mm, endless if it
  /// is not valid. May be null.
  void (*check)(const SceneSpec& spec, double side, FieldChecker& check) = nullptr;
  /// Joints and walls. Every joint and wall is created once, joints in the order of their first use. The extent of the
  /// joints is the envelope.
  Layout (*lay_out)(const SceneSpec& spec) = nullptr;
  /// Length after which a lattice whose sides repeat does so, along x and along y, mm; 0 where its columns or rows
  /// are odd in number and would have to be even.
  Vector2 (*period)(const RegularLattice& lattice) = nullptr;
  ClosedForms (*closed_forms)(const RegularLattice& lattice, LoadingSpec::Direction direction) = nullptr;
  /// The walls of a cell, each once, mm: lengths and angles to the crush. Numbers may be missing. Null: not looked at.
  std::vector<Vector2> (*walls_of_cell)(const RegularLattice& lattice) = nullptr;
  /// For force-based elements, at the direction and speed of the spec. Null: by the angles of its walls.
  DefaultMesh (*mesh)(const SceneSpec& spec) = nullptr;
  /// When not to compare it with theory, as sentences; null or empty where theory applies. Numbers may be missing.
  std::string (*theory_note)(const RegularLattice& lattice) = nullptr;
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

/// A number of its own: as given, or its default. REQUIRES: a number of its kind.
double own_number(const RegularLattice& lattice, std::string_view name);

/// Plate speed beyond which a mesh must resolve more, m/s.
inline constexpr double kSlowCrush = 25.0;

/// Whether the plate is faster than kSlowCrush.
bool is_fast_crush(const SceneSpec& spec);

/// The mesh of a spec of a kind.
DefaultMesh mesh_of(const LatticeKind& kind, const SceneSpec& spec);

/// The mesh of walls that bend, by their slenderness, their angle to the crush and its speed. In a fast crush, walls of
/// one element cannot fold: those of the crushed layer overlap, by half of its volume at 100 m/s, and the run ends.
/// Walls along the crush must then be finer: if more than a quarter of the length of the walls lies within 15 degrees
/// of the crush. So must stout walls, and slender ones beyond 10 m/s. STANDARD is meant to be the coarsest mesh whose
/// plateau stresses lie within 5 % (impact) and 10 % (support) of a mesh twice as fine; how far each lattice is:
/// core/what-is-computed.md.
DefaultMesh mesh_of_bent_walls(const SceneSpec& spec, std::string of_what);

/// The mesh of walls along the crush, which buckle in short waves: elements as long as a stout wall is thick, and at
/// most 16 a wall.
DefaultMesh mesh_of_stacked_walls(const SceneSpec& spec, std::string_view plural);

/// The theory note of a lattice whose walls yield axially.
std::string note_of_stretched_walls(const std::string& plural);

/// That of a lattice whose walls turn: `measured` is what plateaus were over the collapse stress.
std::string note_of_turning_walls(const std::string& measured);

}  // namespace cellcrush
