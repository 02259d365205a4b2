#include "scenes/experiments.h"

#include <utility>

#include "scenes/lattices.h"

namespace cellcrush::scenes {
namespace {

using Edge = LoadsSpec::Edge;

/// Hexagons of aluminium with a small imperfection, without plates.
SceneSpec block(const char* title, int columns, int rows, double thickness) {
  SceneSpec spec;
  spec.title = title;
  spec.lattice = hexagons(columns, rows, 4.0, thickness, thickness);
  spec.imperfection = {0.01, 1};
  spec.depth_mm = 4.0;
  spec.material.youngs_modulus_mpa = 69000.0;
  spec.material.yield_stress_mpa = 76.0;
  spec.material.density_kg_per_m3 = 2700.0;
  return spec;
}

}  // namespace

LoadsSpec::RigidWall wall_at(Edge edge) {
  LoadsSpec::RigidWall wall;
  wall.edge = edge;
  return wall;
}

LoadsSpec::RigidWall striker_at(Edge edge, double mass_g, double speed_m_per_s) {
  LoadsSpec::RigidWall wall = wall_at(edge);
  wall.own = {{"mass_g", mass_g}, {"speed_m_per_s", speed_m_per_s}};
  return wall;
}

SceneSpec struck_block() {
  SceneSpec spec = block("Hexagons struck by a mass", 20, 8, 0.3464);
  spec.loads.rigid_walls = {striker_at(Edge::left, 4.5, 60.0), wall_at(Edge::right)};
  spec.loading.end_time_s = 0.004;
  spec.loading.end_at_rest = 0.001;
  return spec;
}

SceneSpec thrown_block() {
  SceneSpec spec = block("Hexagons thrown at a wall", 20, 8, 0.3464);
  spec.loads.velocity_x_m_per_s = 60.0;
  spec.loads.rigid_walls = {wall_at(Edge::right)};
  spec.loading.end_time_s = 0.003;
  return spec;
}

SceneSpec pressure_pulse() {
  SceneSpec spec = block("Hexagons under a pressure pulse", 20, 8, 0.3464);
  LoadsSpec::RigidWall plate = wall_at(Edge::left);
  plate.own = {{"mass_g", 2.3}};
  plate.functions = {{"pressure_mpa", {{0.0, 2.4}, {3.5e-4, 2.4}, {3.50001e-4, 0.0}}}};
  spec.loads.rigid_walls = {plate, wall_at(Edge::right)};
  spec.loading.end_time_s = 0.004;
  spec.loading.end_at_rest = 0.001;
  return spec;
}

SceneSpec dropped_weight() {
  SceneSpec spec = block("Steel hexagons under a dropped weight", 6, 7, 0.1);
  spec.material.youngs_modulus_mpa = 207000.0;
  spec.material.yield_stress_mpa = 250.0;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.material.cowper_symonds_rate_per_s = 40.4;
  spec.material.cowper_symonds_exponent = 5.0;
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loads.gravity_y_m_per_s2 = -9.81;
  LoadsSpec::RigidWall weight = wall_at(Edge::top);
  weight.own = {{"mass_g", 30.0}, {"drop_height_mm", 1000.0}};
  spec.loads.rigid_walls = {weight, wall_at(Edge::bottom)};
  spec.loading.end_time_s = 0.015;
  spec.loading.end_at_rest = 0.001;
  return spec;
}

SceneSpec loaded_and_unloaded() {
  SceneSpec spec = block("Hexagons loaded and unloaded", 8, 7, 0.2);
  spec.material.yield_stress_mpa = 324.0;
  spec.material.ludwik_stress_mpa = 114.0;
  spec.material.ludwik_exponent = 0.42;
  spec.material.johnson_cook_coefficient = 0.002;
  spec.material.density_kg_per_m3 = 2703.0;
  LoadsSpec::RigidWall plate = wall_at(Edge::left);
  plate.functions = {{"velocity_m_per_s",
                      {{0.0, 0.0},
                       {5e-4, 2.0},
                       {4.5e-3, 2.0},
                       {5e-3, 0.0},
                       {6e-3, 0.0},
                       {6.5e-3, -2.0},
                       {7.5e-3, -2.0},
                       {8.5e-3, 2.0},
                       {0.012, 2.0}}}};
  spec.loads.rigid_walls = {plate, wall_at(Edge::right)};
  spec.loading.end_time_s = 0.012;
  return spec;
}

SceneSpec brittle_lattice() {
  SceneSpec spec = block("Brittle hexagons", 10, 9, 0.4);
  spec.material.youngs_modulus_mpa = 3300.0;
  spec.material.yield_stress_mpa = 55.0;
  spec.material.density_kg_per_m3 = 1240.0;
  spec.material.failure_strain = 0.02;
  spec.loading.speed_m_per_s = 10.0;
  spec.loading.end_strain = 0.6;
  return spec;
}

SceneSpec tension_test() {
  SceneSpec spec = block("Hexagons of a tested aluminium", 8, 7, 0.2);
  spec.material.youngs_modulus_mpa = 64000.0;
  spec.material.yield_stress_mpa = 90.0;
  spec.material.hardening_table = {{0.0, 2e-4, 7e-4, 0.002, 0.005, 0.012, 0.025, 0.036},
                                   {90.0, 106.3, 130.2, 143.6, 150.7, 158.0, 168.9, 175.3},
                                   HardeningTable::Beyond::power_law};
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 5.0;
  spec.loading.end_strain = 0.6;
  return spec;
}

SceneSpec voce_hardening() {
  SceneSpec spec = block("Hexagons with Voce's hardening", 8, 7, 0.2);
  spec.material.voce_stress_mpa = 60.0;
  spec.material.voce_exponent = 40.0;
  spec.material.isotropic_fraction = 0.5;
  LoadsSpec::RigidWall plate = wall_at(Edge::left);
  plate.points = {{0.0, 0.0}, {0.003, 6.0}, {0.004, 5.5}, {0.007, 10.0}, {0.008, 9.5}};
  spec.loads.rigid_walls = {plate, wall_at(Edge::right)};
  spec.loading.end_time_s = 0.008;
  return spec;
}

SceneSpec thick_hexagons() {
  SceneSpec spec = block("Thick hexagons", 10, 9, 0.8);
  spec.material.poissons_ratio = 0.3;
  spec.section.shear_deformation = true;
  spec.section.rigid_joints = true;
  spec.loading.speed_m_per_s = 10.0;
  spec.loading.end_strain = 0.5;
  return spec;
}

SceneSpec measured_ring() {
  constexpr double kRadius = 47.98;
  constexpr double kRise = -14.053;  // of a quarter, to its right
  NetworkWalls ring;
  ring.joints_mm = {0.0, -kRadius, kRadius, 0.0, 0.0, kRadius, -kRadius, 0.0};
  ring.walls = {0, 1, 1, 2, 2, 3, 3, 0};
  ring.rises_mm = {kRise, kRise, kRise, kRise};
  ring.wall_thickness_mm = 4.04;
  SceneSpec spec;
  spec.title = "Aluminium ring between plates";
  spec.lattice = ring;
  spec.elements_per_wall = 16;
  spec.depth_mm = 15.0;
  spec.material.youngs_modulus_mpa = 64000.0;
  spec.material.yield_stress_mpa = 90.0;
  spec.material.density_kg_per_m3 = 2700.0;
  spec.material.poissons_ratio = 0.3;
  spec.material.plane = MaterialSpec::Plane::strip;
  spec.material.hardening_table = {
      {0.0, 1e-4, 2e-4, 4e-4, 7e-4, 1e-3, 1.5e-3, 2e-3, 3e-3, 5e-3, 8e-3, 0.012, 0.018, 0.025, 0.031, 0.036},
      {90.0, 93.2, 106.3, 120.4, 130.2, 135.4, 140.4, 143.6, 147.1, 150.7, 154.0, 158.0, 163.4, 168.9, 172.8, 175.3},
      HardeningTable::Beyond::power_law};
  LoadsSpec::RigidWall press = wall_at(Edge::top);
  press.functions = {{"velocity_m_per_s",
                      {{0.0, 0.0},
                       {0.01, 0.78122},
                       {0.06, 0.78122},
                       {0.065, 0.0},
                       {0.07, -1.0},
                       {0.08, -1.0},
                       {0.085, 0.0}}}};
  spec.loads.rigid_walls = {wall_at(Edge::bottom), press};
  spec.loading.end_time_s = 0.1;
  spec.numerics.mass_damping_per_s = 200.0;
  spec.output.frame_count = 40;
  return spec;
}

}  // namespace cellcrush::scenes
