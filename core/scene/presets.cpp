#include "cellcrush/presets.h"

#include <algorithm>
#include <array>

namespace cellcrush {
namespace {

// Aluminium as the studies of this scene usually take it.
MaterialSpec perfectly_plastic_aluminium() {
  MaterialSpec material;
  material.youngs_modulus_mpa = 69000.0;
  material.yield_stress_mpa = 76.0;
  material.density_kg_per_m3 = 2700.0;
  return material;
}

const std::string kMaterialAssumption =
    "The material of Example 2 stands only in a figure that is lost: E = 69 GPa, yield stress 76 MPa, perfectly "
    "plastic, is "
    "the usual choice for this scene.";
const std::string kThicknessAssumption =
    "Eq. 50 of the paper is inverted: the wall thickness 0.3464 mm is that of relative density 0.1, (2/sqrt(3)) h/L.";
const std::string kContactAssumption =
    "The paper gives neither penalty stiffness nor contact damping: k = 0.25 m / dt_crit^2 and a fifth of critical.";

// Example 2 of the paper, Type I, at 100 m/s.
Preset type_i() {
  SceneSpec spec;
  spec.title = "Type I: 21 rows of 74 and 73 hexagons, crushed along the rows at 100 m/s";
  HexagonLattice hexagon;
  hexagon.columns = 74;
  hexagon.rows = 21;
  hexagon.side_mm = 4.0;
  hexagon.wall_thickness_mm = 0.3464;
  hexagon.vertical_wall_thickness_mm = 0.3464;
  spec.lattice = hexagon;
  spec.depth_mm = 4.0;
  spec.material = perfectly_plastic_aluminium();
  spec.loading.speed_m_per_s = 100.0;
  spec.numerics.time_step_s = 2e-7;
  return {"type-i",
          "Wu, Tsai and Lee, Example 2, Type I: hexagons at relative density 0.1, 8099 particles",
          {kMaterialAssumption, kThicknessAssumption, kContactAssumption},
          spec};
}

// The same cells, few enough for a first look.
Preset hexagon_small() {
  Preset preset = type_i();
  preset.name = "hexagon-small";
  preset.title = "A first look: 7 rows of 20 and 19 hexagons of Type I, done in seconds";
  preset.spec.title = "7 rows of 20 and 19 hexagons, crushed along the rows at 100 m/s";
  auto& hexagon = std::get<HexagonLattice>(preset.spec.lattice);
  hexagon.columns = 20;
  hexagon.rows = 7;
  return preset;
}

}  // namespace

std::span<const Preset> presets() {
  static const std::array<Preset, 2> kPresets = {hexagon_small(), type_i()};
  return kPresets;
}

const Preset* find_preset(std::string_view name) {
  const auto all = presets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Preset& preset) { return preset.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace cellcrush
