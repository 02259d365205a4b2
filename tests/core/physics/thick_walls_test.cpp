// Walls that shear (E5i), against closed forms of Timoshenko beams: cantilever, guided wall, hexagons, natural
// frequency, plastic moment, ledger. Elements alone are held to the oracle in oracle/element_test.cpp. Blind to: the
// size of joints, and whether a beam describes a wall that is half as thick as long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "measure/fibre_strain.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush::thick_walls {
namespace {

using std::numbers::pi;
using Component = FrameLattice::Component;

constexpr double kLength = 10.0;  // mm
constexpr double kModulus = 70000.0;
constexpr double kPoissonsRatio = 0.33;
constexpr double kShearFactor = 5.0 / 6.0;
constexpr double kSlendernesses[] = {0.1, 0.2, 0.3, 0.5};

/// Shear deflection of a wall between guided ends over its deflection by bending, 12 EI / (kappa G A l^2), over
/// (h/l)^2: in plane stress.
constexpr double kShare = 2.0 * (1.0 + kPoissonsRatio) / kShearFactor;

double wave_speed() { return std::sqrt(kModulus / (scenes::kDensity * 1e-12)); }

/// First natural frequency of a slender cantilever, 1/s.
double cantilever_frequency(double length, double thickness) {
  return 3.516 * wave_speed() * thickness / std::sqrt(12.0) / (length * length);
}

/// Elastic walls that shear, in double precision, whose loads and motions rise over `rise` and rest as long again, in
/// radians of a frequency. The damping is that frequency times `damping`.
SceneSpec slow(FrameLattice frame, double frequency, double rise, double damping) {
  const double rise_time = rise / frequency;
  for (auto& load : frame.loads) load.points.back().first = rise_time;
  for (auto& motion : frame.motions) motion.points.back().first = rise_time;
  frame.end_time_s = 2.0 * rise_time;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  spec.section.shear_deformation = true;
  spec.numerics.mass_damping_per_s = damping * frequency;
  spec.output.sample_count = 20;
  return spec;
}

FrameLattice::TimeFunction rise_to(double value) { return {{0.0, 0.0}, {1.0, value}}; }

double bending_stiffness(double thickness) { return kModulus * thickness * thickness * thickness / 12.0; }

double error_of(double value, double exact) { return std::abs(value / exact - 1.0); }

TEST(ThickWalls, TipOfACantileverBendsAndShears) {
  double worst = 0.0;
  double worst_strain = 0.0;
  for (const double slenderness : kSlendernesses) {
    for (const int elements : {1, 2, 4}) {
      const double thickness = slenderness * kLength;
      FrameLattice frame = scenes::bar(kLength, thickness, elements);
      const double load = 1e-6 * kModulus * thickness * slenderness * slenderness;
      frame.supports = {{0, true, true, true}};
      frame.loads = {{1, Component::y, rise_to(load)}};
      frame.watched_nodes = {1};
      const auto scene = scenes::build(slow(frame, cantilever_frequency(kLength, thickness), 60.0, 1.0));
      Simulation simulation(scene);
      const auto samples = scenes::run_to_end(simulation);
      const double bending = load * std::pow(kLength, 3) / (3.0 * bending_stiffness(thickness));
      const double exact = bending * (1.0 + 0.25 * kShare * slenderness * slenderness);
      worst = std::max(worst, error_of(samples.back().watched.front().uy, exact));
      const double strain = 0.5 * thickness * load * kLength / bending_stiffness(thickness);
      worst_strain =
          std::max(worst_strain,
                   error_of(find_largest_fibre_strain(*scene, simulation.state(), scene->walls.blocks).strain, strain));
    }
  }
  scenes::record_bound("error", worst, 1e-3);
  scenes::record_bound("fibre strain", worst_strain, 1e-3);
}

/// Half of the elastic energy of a wall whose end moves across by 1 mm, of both ends held against turning, over that
/// of a slender one.
double guided_stiffness(SceneSpec spec, double thickness) {
  constexpr double kMotion = 1e-5 * kLength;
  FrameLattice frame = scenes::bar(kLength, thickness, 2);
  frame.supports = {{0, true, true, true}, {1, false, false, true}};
  frame.motions = {{1, Component::y, rise_to(kMotion)}};
  SceneSpec moved = slow(frame, cantilever_frequency(kLength, thickness), 60.0, 1.0);
  moved.material = spec.material;
  moved.section = spec.section;
  const double energy = scenes::run_frame(moved).back().energies.elastic;
  const double modulus = spec.material.plane == MaterialSpec::Plane::strain
                             ? kModulus / (1.0 - kPoissonsRatio * kPoissonsRatio)
                             : kModulus;
  return 2.0 * energy / (kMotion * kMotion) / (12.0 * modulus / kModulus * bending_stiffness(thickness)) *
         std::pow(kLength, 3);
}

TEST(ThickWalls, BetweenGuidedEndsStoreTheEnergyOfBendingAndShear) {
  double worst = 0.0;
  SceneSpec spec = slow(scenes::bar(kLength, 1.0, 2), 1.0, 1.0, 1.0);
  for (const double slenderness : kSlendernesses) {
    const double exact = 1.0 / (1.0 + kShare * slenderness * slenderness);
    worst = std::max(worst, error_of(guided_stiffness(spec, slenderness * kLength), exact));
  }
  scenes::record_bound("error", worst, 1e-3);
}

// A wall that is held along its depth is stiffer in bending by 1 / (1 - nu^2), but shears as before.
TEST(ThickWalls, InPlaneStrainHaveTheShearModulusOfPlaneStress) {
  SceneSpec spec = slow(scenes::bar(kLength, 1.0, 2), 1.0, 1.0, 1.0);
  spec.material.plane = MaterialSpec::Plane::strain;
  spec.section.shear_factor = 0.7;
  const double share = 2.0 / (1.0 - kPoissonsRatio) / 0.7;
  scenes::record_bound("error", error_of(guided_stiffness(spec, 0.3 * kLength), 1.0 / (1.0 + share * 0.09)), 1e-3);
}

/// Strain of endless regular hexagons along y and along x under a stress along an axis: half of a cell as in
/// lattice_moduli_test.cpp.
struct HexagonStrains {
  double x;
  double y;
};
HexagonStrains hexagon_strains(double ratio, double stress_x, double stress_y) {
  const double thickness = ratio * kLength;
  const double width = 0.25 * std::numbers::sqrt3 * kLength;
  const double height = 0.75 * kLength;
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {0.0, -0.5 * kLength, 0.0, 0.0}, {width, 0.25 * kLength, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 0.5 * thickness, 2), scenes::beam(0, 2, thickness, 2)};
  frame.supports = {{0, true, false, true}, {1, true, true, true}};
  frame.watched_nodes = {2};
  frame.loads = {{2, Component::x, rise_to(1.5 * kLength * stress_x)},
                 {2, Component::y, rise_to(0.5 * std::numbers::sqrt3 * kLength * stress_y)}};
  const auto samples = scenes::run_frame(slow(frame, cantilever_frequency(0.5 * kLength, thickness), 60.0, 1.0));
  const WatchedNode& node = samples.back().watched.front();
  return {node.ux / width, node.uy / height};
}

// Gibson and Ashby, with the axial stretch of the walls and their shear: E* = 4/sqrt3 E r^3 / (1 + (3 + 2 (1 + nu) /
// kappa) r^2), which is isotropic.
TEST(ThickWalls, HexagonsHaveTheModulusOfWallsThatBendStretchAndShear) {
  double worst = 0.0;
  double worst_ratio = 0.0;
  double excess = 0.0;  // of a modulus without shear
  for (const double ratio : kSlendernesses) {
    const double square = ratio * ratio;
    const double compliance = 1.0 + (3.0 + kShare) * square;
    const double modulus = 4.0 / std::numbers::sqrt3 * kModulus * ratio * square / compliance;
    const double poissons_ratio = (1.0 + (kShare - 1.0) * square) / compliance;
    const double stress = -2e-5 * modulus;
    const HexagonStrains along = hexagon_strains(ratio, 0.0, stress);
    const HexagonStrains across = hexagon_strains(ratio, stress, 0.0);
    for (const double strain : {along.y, across.x}) worst = std::max(worst, error_of(stress / strain, modulus));
    for (const double nu : {-along.x / along.y, -across.y / across.x}) {
      worst_ratio = std::max(worst_ratio, std::abs(nu - poissons_ratio));
    }
    if (ratio == 0.2) excess = compliance / (1.0 + 3.0 * square) - 1.0;
  }
  scenes::record_bound("modulus", worst, 5e-3);
  scenes::record_bound("nu", worst_ratio, 5e-3);
  scenes::record_figure("excess without shear in % at 0.2", 100.0 * excess, 3);
}

/// First frequency of a beam on simple supports with rotary inertia and shear (Timoshenko 1921), 1/s.
double timoshenko_frequency(double thickness) {
  const double k2 = std::pow(pi / kLength, 2);
  const double gyration2 = thickness * thickness / 12.0;
  const double c2 = wave_speed() * wave_speed();
  // a w^2 - b w + c = 0 with w = omega^2 / c^2; E / (kappa G) is kShare.
  const double a = gyration2 * kShare;
  const double b = 1.0 + gyration2 * k2 * (1.0 + kShare);
  const double c = gyration2 * k2 * k2;
  return std::sqrt(c2 * 2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c)));
}

/// The same of the solver's beam, which starts with half a sine wave of velocity: from zero crossings of its middle.
double swinging_frequency(double thickness, int elements) {
  FrameLattice frame = scenes::bar(kLength, thickness, elements);
  frame.supports = {{0, true, true, false}, {1, false, true, false}};
  const double expected = timoshenko_frequency(thickness);
  frame.end_time_s = 6.0 * 2.0 * pi / expected;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(frame));
  spec.section.shear_deformation = true;
  spec.numerics.time_step_s = 2.0 * pi / expected / 4000.0;
  const auto scene = scenes::build(spec);
  const double k = pi / kLength;
  const double speed = 1e-5 * thickness * expected;
  const double turn = k * (1.0 - kShare * std::pow(expected / wave_speed() / k, 2));  // of a section over deflection
  scene->initial_velocity.assign(scene->particle_count(), Vector2::Zero());
  scene->initial_spin.assign(scene->particle_count(), 0.0);
  std::vector<double> shape;
  for (std::size_t i = 0; i < scene->particle_count(); ++i) {
    const double x = scene->position[i].x();
    shape.push_back(i < 2 ? 0.0 : std::sin(k * x));
    scene->initial_velocity[i].y() = speed * shape.back();
    scene->initial_spin[i] = speed * turn * std::cos(k * x);
  }
  Simulation simulation(scene);
  std::vector<double> crossings;
  double before = 0.0;
  while (crossings.size() < 11 && simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    double now = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i) now += shape[i] * simulation.state().position[i].y();
    if (now * before < 0.0) crossings.push_back(simulation.time());
    before = now;
  }
  EXPECT_EQ(crossings.size(), 11u);
  return 10.0 * pi / (crossings.back() - crossings.front());
}

/// Moment at the root of a perfectly plastic cantilever, h/l = 0.3, whose tip has moved by eight times the deflection
/// at which it would have yielded, over sigma_y b h^2 / 4.
double plastic_moment(bool shears) {
  constexpr double kThickness = 0.3 * kLength;
  constexpr double kYieldStress = kModulus / 5000.0;
  FrameLattice frame = scenes::bar(kLength, kThickness, 2);
  const double way = 8.0 * 2.0 / 3.0 * kYieldStress / kModulus * kLength * kLength / kThickness;
  frame.supports = {{0, true, true, true}};
  frame.motions = {{1, Component::y, rise_to(way)}};
  frame.watched_nodes = {0};
  SceneSpec spec = slow(frame, cantilever_frequency(kLength, kThickness), 600.0, 0.5);
  spec.material.yield_stress_mpa = kYieldStress;
  spec.section.shear_deformation = shears;
  const double moment = scenes::run_frame(spec).back().watched.front().reaction_moment;
  return std::abs(moment) / (0.25 * kYieldStress * kThickness * kThickness);
}

// Shear is elastic: it neither yields nor takes part in the yielding of the fibres.
TEST(ThickWalls, BearTheFullPlasticMoment) {
  const double moment = plastic_moment(true);
  scenes::record_figure("moment", moment, 3, {1.0, 0.01});
  EXPECT_NEAR(moment / plastic_moment(false), 1.0, 1e-3);
}

// Hexagons with h/L = 0.2 at 100 m/s, to a strain of 0.4.
TEST(ThickWalls, CloseTheLedgerOfACrush) {
  for (const bool coupled : {false, true}) {
    SceneSpec spec = scenes::hexagon_specimen(8, 5);
    scenes::cells_of(spec).own.clear();
    scenes::cells_of(spec).wall_thickness_mm = 0.2 * *scenes::cells_of(spec).side_mm;
    spec.loading.end_strain = coupled ? 0.7 : 0.4;
    spec.section.shear_deformation = true;
    spec.section.coupled_bending = coupled;
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    const auto samples = scenes::run_to_end(simulation);
    EXPECT_GT(samples.back().energies.plastic, 0.2 * samples.back().energies.external);
    scenes::record_bound(coupled ? "coupled residual in %" : "residual in %",
                         100.0 * summarize(*scene, samples).energy_error_relative, 1.0);
  }
}

TEST(ThickWalls, SwingAsTimoshenkoBeams) {
  double worst = 0.0;
  for (const double slenderness : {0.1, 0.2, 0.3}) {
    const double exact = timoshenko_frequency(slenderness * kLength);
    worst = std::max(worst, error_of(swinging_frequency(slenderness * kLength, 16), exact));
  }
  scenes::record_bound("error in %", 100.0 * worst, 1.0);
}

}  // namespace
}  // namespace cellcrush::thick_walls
