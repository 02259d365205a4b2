#include "cellcrush/presets.h"

#include <algorithm>

namespace cellcrush {
namespace {

/// Perfectly plastic aluminium.
MaterialSpec aluminium(double youngs_modulus_mpa, double yield_stress_mpa) {
  MaterialSpec material;
  material.youngs_modulus_mpa = youngs_modulus_mpa;
  material.yield_stress_mpa = yield_stress_mpa;
  material.density_kg_per_m3 = 2700.0;
  return material;
}

const std::string kMaterialAssumption =
    "The material of Example 2 is given only in a figure that is not available. E = 69 GPa, yield stress 76 MPa and "
    "perfect plasticity are the usual choice for this problem.";
const std::string kThicknessAssumption =
    "Eq. 50 of the paper is inverted. The wall thickness of 0.3464 mm corresponds to relative density 0.1 = "
    "(2/sqrt(3)) h/L.";
const std::string kContactAssumption =
    "The paper gives neither penalty stiffness nor contact damping. Here a particle at plate speed penetrates a wall "
    "by at most one sixth of its thickness, and damping is one fifth of critical.";
const std::string kStepAssumption =
    "Time step and integration points are the defaults. The paper uses numerics.time_step_s 2e-7, section.formulation "
    "DISPLACEMENT_BASED, section.depth_rule LOBATTO and section.area_rule CONSTANT_AREA.";

const std::string kCountsAssumption =
    "For Types II and III the paper's text contradicts its particle counts; each reading has its own preset.";

// Example 2 of the paper, Type I, at 100 m/s.
Preset type_i() {
  SceneSpec spec;
  spec.title = "Type I hexagons";
  spec.lattice = HexagonLattice{{.columns = 74, .rows = 21, .side_mm = 4.0, .wall_thickness_mm = 0.3464}, 0.3464};
  spec.depth_mm = 4.0;
  spec.material = aluminium(69000.0, 76.0);
  spec.loading.speed_m_per_s = 100.0;
  return {"type-i",
          "Wu, Tsai and Lee, Example 2, Type I: hexagons at relative density 0.1, 8099 particles",
          {kMaterialAssumption, kThicknessAssumption, kContactAssumption, kStepAssumption},
          spec};
}

// The same cells, few enough for a first run.
Preset hexagon_small() {
  Preset preset = type_i();
  preset.name = "hexagon-small";
  preset.title = "A first look: 7 rows of 20 and 19 hexagons of Type I, done in seconds";
  preset.spec.title = "A small specimen of Type I hexagons";
  auto& hexagon = std::get<HexagonLattice>(preset.spec.lattice);
  hexagon.columns = 20;
  hexagon.rows = 7;
  return preset;
}

// Example 2, Types II and III. The wall thickness gives relative density 0.1 by Eq. 48 and 49.
Preset type_ii(const std::string& reading, int columns, int rows, double side) {
  Preset preset = type_i();
  preset.name = "type-ii-" + reading;
  preset.title = "Wu, Tsai and Lee, Example 2, Type II: squares at relative density 0.1, " + reading;
  preset.spec.title = "Type II squares, " + reading;
  preset.assumptions = {kMaterialAssumption, kCountsAssumption, kContactAssumption, kStepAssumption};
  preset.spec.lattice = SquareLattice{{columns, rows, side, 0.05132 * side}};
  return preset;
}

Preset type_iii(const std::string& reading, int columns, int rows, double side) {
  Preset preset = type_ii(reading, columns, rows, side);
  preset.name = "type-iii-" + reading;
  preset.title = "Wu, Tsai and Lee, Example 2, Type III: triangles at relative density 0.1, " + reading;
  preset.spec.title = "Type III triangles, " + reading;
  preset.assumptions.push_back("One family of walls is parallel to the crush direction.");
  preset.spec.lattice = TriangleLattice{{columns, rows, side, 0.02963 * side}};
  return preset;
}

// Example 1: the quasi-static test of Papka and Kyriakides, by explicit steps with real masses, slow enough for it.
Preset papka_kyriakides(const std::string& number, double side, double thickness) {
  SceneSpec spec;
  spec.title = "Hexagons of Papka and Kyriakides, dimensions " + number;
  spec.lattice =
      HexagonLattice{{.columns = 10, .rows = 15, .side_mm = side, .wall_thickness_mm = thickness}, 2.0 * thickness};
  spec.depth_mm = 1.0;
  spec.material = aluminium(69000.0, 292.0);
  spec.material.hardening_modulus_mpa = 69000.0 * 690.0 / (69000.0 - 690.0);
  spec.plates.friction = 0.2;
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 1.0;
  spec.numerics.mass_damping_per_s = 100.0;
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  return {
      "papka-kyriakides-" + number,
      "Wu, Tsai and Lee, Example 1, dimensions " + number +
          ": quasi-static crush of Al 5052-H39 hexagons, 814 particles",
      {"The paper uses dynamic relaxation with a step of 2e-6 s, 6.4 times the stability limit of the real masses. "
       "Here the masses are real, and 1 m/s with mass damping of 100 1/s is slow enough to be quasi-static.",
       "The integration points are the paper's, which make the joints up to one quarter too strong. The limit stress "
       "is about one tenth above that of section.formulation FORCE_BASED with section.depth_rule FULL_MOMENT.",
       "The paper's fixed plate A is the support plate. Friction of 0.2 acts at both plates, not between walls.",
       kContactAssumption},
      spec};
}

// Example 3: hexagons with rows of stiff cells.
Preset inclusions(std::vector<int> rows) {
  SceneSpec spec;
  const std::string count = std::to_string(rows.size());
  spec.title = "Hexagons with " + count + " lines of stiff inclusions";
  spec.lattice = HexagonLattice{{.columns = 20, .rows = 21, .side_mm = 5.0, .wall_thickness_mm = 0.1}, 0.1};
  spec.inclusions.rows = std::move(rows);
  spec.depth_mm = 5.0;
  spec.elements_per_wall = 10;
  spec.material = aluminium(70000.0, 34.0);
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 1.0;
  spec.loading.end_strain = spec.inclusions.rows.size() > 2 ? 0.65 : 0.85;
  spec.plates.friction = 0.2;
  return {"inclusions-" + count,
          "Wu, Tsai and Lee, Example 3: " + count + " lines of stiff inclusions, 10 elements a wall",
          {("The paper gives the crush direction and the positions of the lines only in figures that are not "
            "available. Here whole rows lie across the crush direction, evenly spaced."),
           ("A stiff cell has walls 4 times as thick and does not deform. With MESHED, its walls are 64 times as stiff "
            "in bending."),
           ("Friction of 0.2 acts at both plates, as in Example 1. The paper gives none here, but without it the "
            "specimen splits into two sliding halves before it densifies."),
           "With six lines the rigid cells lock up at 66 % strain, so the run ends at 65 %.",
           "The time step is automatic; the paper's is 2e-8 s (numerics.time_step_s).", kContactAssumption},
          spec};
}

}  // namespace

std::span<const Preset> presets() {
  static const std::vector<Preset> kPresets = {
      hexagon_small(),
      papka_kyriakides("1", 5.51, 0.1448),
      papka_kyriakides("2", 5.49, 0.1194),
      type_i(),
      type_ii("as-stated", 128, 32, 4.0),
      type_ii("as-counted", 73, 18, 512.0 / 73.0),
      type_iii("as-stated", 128, 37, 4.0),
      type_iii("as-counted", 74, 21, 512.0 / 74.0),
      inclusions({}),
      inclusions({8, 14}),
      inclusions({3, 6, 9, 13, 16, 19}),
  };
  return kPresets;
}

const Preset* find_preset(std::string_view name) {
  const auto found = std::ranges::find(presets(), name, &Preset::name);
  return found == presets().end() ? nullptr : &*found;
}

}  // namespace cellcrush
