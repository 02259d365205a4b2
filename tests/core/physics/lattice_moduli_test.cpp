// Unit cells of lattices as explicit frames, against the closed forms of their beams. Under even strain the middle of
// every wall is a centre of inversion: no moment there, and it moves as the strain says; a cell is a joint with its
// half walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

constexpr double kSide = 10.0;  // L, mm
constexpr double kModulus = 70000.0;
constexpr double kSqrt3 = std::numbers::sqrt3;
constexpr double kHexagonHeight = 0.75 * kSide;  // of the half cell below
constexpr double kHexagonWidth = 0.25 * kSqrt3 * kSide;
constexpr double kTriangleArea = 0.5 * kSqrt3 * kSide * kSide;
constexpr double kSquareArea = kSide * kSide;
constexpr double kStrain = 2e-5;

using Component = FrameLattice::Component;

/// First natural frequency of a half wall as a cantilever, 1/s.
double half_wall_frequency(double thickness) {
  const double wave_speed = std::sqrt(kModulus / (scenes::kDensity * 1e-12));
  return 3.516 * wave_speed * thickness / std::sqrt(12.0) / (0.25 * kSide * kSide);
}

/// A case whose loads or motions rise over `rise` and rest as long again; times are in radians of half a wall's
/// frequency.
SceneSpec slow_frame(FrameLattice frame, double thickness, double rise, double damping) {
  const double frequency = half_wall_frequency(thickness);
  const double rise_time = rise / frequency;
  for (auto& load : frame.loads) {
    load.points.back().first = rise_time;
  }
  for (auto& motion : frame.motions) {
    motion.points.back().first = rise_time;
  }
  frame.end_time_s = 2.0 * rise_time;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.numerics.mass_damping_per_s = damping * frequency;
  spec.output.sample_count = 20;
  return spec;
}

/// A rise from 0 to `value`; slow_frame says when.
FrameLattice::TimeFunction rise_to(double value) { return {{0.0, 0.0}, {1.0, value}}; }

FrameLattice half_hexagon(double thickness, int elements) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {0.0, -0.5 * kSide, 0.0, 0.0}, {kHexagonWidth, 0.25 * kSide, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 0.5 * thickness, elements), scenes::beam(0, 2, thickness, elements)};
  frame.supports = {{0, true, false, true}, {1, true, true, true}};
  frame.watched_nodes = {2};
  return frame;
}

/// Half walls from one joint in these directions, each with its opposite, and their ends moved evenly.
SceneSpec strained_joint(const std::vector<double>& angles, double thickness, double strain_x, double strain_y) {
  FrameLattice frame;
  frame.nodes.push_back({0.0, 0.0, 0.0, 0.0});
  for (const double angle : angles) {
    for (const double sign : {1.0, -1.0}) {
      const double x = sign * 0.5 * kSide * std::cos(angle);
      const double y = sign * 0.5 * kSide * std::sin(angle);
      const int node = static_cast<int>(frame.nodes.size());
      frame.nodes.push_back({x, y, 0.0, 0.0});
      frame.beams.push_back(scenes::beam(0, node, thickness, 2));
      frame.motions.push_back({node, Component::x, rise_to(strain_x * x)});
      frame.motions.push_back({node, Component::y, rise_to(strain_y * y)});
    }
  }
  return slow_frame(std::move(frame), thickness, 60.0, 1.0);
}

/// Half of a hexagon's cell, cut along its vertical wall: the wall's middle stands, the joint neither turns nor leaves
/// the cut, and the middle of the slanted wall, which is watched, bears a dead load in N. A stress s in MPa is a load
/// (1.5 L s, 0) along x, (0, L cos 30 s) along y.
SceneSpec loaded_hexagon(double thickness, double load_x, double load_y) {
  FrameLattice frame = half_hexagon(thickness, 2);
  frame.loads = {{2, Component::x, rise_to(load_x)}, {2, Component::y, rise_to(load_y)}};
  return slow_frame(std::move(frame), thickness, 60.0, 1.0);
}

/// The same cell, perfectly plastic, its watched node pushed down to a strain.
SceneSpec crushed_hexagon(double thickness, double yield_stress, double strain, int elements,
                          const SectionSpec& section) {
  FrameLattice frame = half_hexagon(thickness, elements);
  frame.motions = {{2, Component::y, rise_to(-strain * kHexagonHeight)}};
  SceneSpec spec = slow_frame(std::move(frame), thickness, 1500.0, 0.2);
  spec.loading.end_time_s = spec.loads.motions.front().points.back().first;
  spec.material.yield_stress_mpa = yield_stress;
  spec.section = section;
  spec.output.sample_count = 200;
  return spec;
}

/// A joint of triangles (walls along x and at 60 and 120 degrees) or of squares, the middles of its walls moved as an
/// even strain says.
SceneSpec strained_triangle(double thickness, double strain_x, double strain_y) {
  return strained_joint({0.0, std::numbers::pi / 3.0, 2.0 * std::numbers::pi / 3.0}, thickness, strain_x, strain_y);
}

SceneSpec strained_square(double thickness, double strain_x, double strain_y) {
  return strained_joint({0.0, 0.5 * std::numbers::pi}, thickness, strain_x, strain_y);
}

/// A specimen of hexagons with free sides, `columns` cells wide and endless along y: the zigzag between two lines of
/// symmetry, of height 1.5 L and width sqrt 3 L columns, strained along y.
SceneSpec strained_hexagon_strip(double thickness, int columns, double strain) {
  const double pitch = 0.5 * kSqrt3 * kSide;
  FrameLattice frame;
  for (int i = 0; i <= 2 * columns; ++i) {
    const bool low = i % 2 == 0;
    const int joint = static_cast<int>(frame.nodes.size());
    frame.nodes.push_back({i * pitch, low ? 0.0 : 0.5 * kSide, 0.0, 0.0});
    frame.nodes.push_back({i * pitch, low ? -0.5 * kSide : kSide, 0.0, 0.0});
    frame.beams.push_back(scenes::beam(joint, joint + 1, thickness, 1));
    if (i > 0) {
      frame.beams.push_back(scenes::beam(joint - 2, joint, thickness, 1));
    }
    frame.supports.push_back({joint + 1, i == 0, low, true});
    if (!low) {
      frame.motions.push_back({joint + 1, Component::y, rise_to(-strain * 1.5 * kSide)});
    }
  }
  return slow_frame(std::move(frame), thickness, 250.0 * columns, 1.0 / columns);
}

/// Moduli of the regular hexagon, shear of the walls left out (Gibson and Ashby, with the walls' axial stretch).
double hexagon_modulus(double ratio) {
  return 4.0 / kSqrt3 * kModulus * ratio * ratio * ratio / (1.0 + 3.0 * ratio * ratio);
}
double hexagon_poissons_ratio(double ratio) { return (1.0 - ratio * ratio) / (1.0 + 3.0 * ratio * ratio); }

void note_error(double& worst, double value, double exact) {
  EXPECT_NEAR(value, exact, 1e-3);
  worst = std::max(worst, std::abs(value - exact));
}

struct Strains {
  double x;
  double y;
};

Strains hexagon_strains(double ratio, double load_x, double load_y) {
  const auto samples = scenes::run_frame(loaded_hexagon(ratio * kSide, load_x, load_y));
  const WatchedNode& node = samples.back().watched.front();
  return {node.ux / kHexagonWidth, node.uy / kHexagonHeight};
}

TEST(LatticeModuli, HexagonCellIsIsotropicWithTheModulusAndPoissonsRatioOfItsBeams) {
  double worst_modulus = 0.0;
  double worst_ratio = 0.0;
  for (const double ratio : {0.1448 / 5.51, 0.1}) {
    SCOPED_TRACE(ratio);
    const double modulus = hexagon_modulus(ratio);
    const double stress = -kStrain * modulus;
    const Strains along = hexagon_strains(ratio, 0.0, stress * kSide * kSqrt3 / 2.0);
    const Strains across = hexagon_strains(ratio, stress * kSide * 1.5, 0.0);
    note_error(worst_modulus, stress / along.y / modulus, 1.0);
    note_error(worst_modulus, stress / across.x / modulus, 1.0);
    note_error(worst_ratio, -along.x / along.y, hexagon_poissons_ratio(ratio));
    note_error(worst_ratio, -across.y / across.x, hexagon_poissons_ratio(ratio));
  }
  scenes::record_figure("hexagons E*", worst_modulus, 1);
  scenes::record_figure("hexagons nu", worst_ratio, 1);
}

using StrainedCell = SceneSpec (*)(double thickness, double strain_x, double strain_y);

/// Modulus along y of a cell of which the elastic energy under three even strains is known.
double modulus_from_energy(StrainedCell cell, double thickness, double area) {
  const auto stiffness = [&](double x, double y) {
    return 2.0 * scenes::run_frame(cell(thickness, kStrain * x, kStrain * y)).back().energies.elastic /
           (area * kStrain * kStrain);
  };
  const double along_x = stiffness(1.0, 0.0);
  const double along_y = stiffness(0.0, 1.0);
  const double coupling = 0.5 * (stiffness(1.0, 1.0) - along_x - along_y);
  return along_y - coupling * coupling / along_x;
}

TEST(LatticeModuli, SquareCellIsAsStiffAsItsWallsAlongTheLoad) {
  const double thickness = 0.05132 * kSide;
  const double modulus = modulus_from_energy(strained_square, thickness, kSquareArea);
  scenes::record_figure("squares", std::abs(modulus / (kModulus * 0.05132) - 1.0), 1, {0.0, 1e-3});
}

TEST(LatticeModuli, TriangleCellIsAsStiffAsItsWallsAndTheirBending) {
  double worst = 0.0;
  for (const double ratio : {0.02963, 0.1}) {
    const double modulus = modulus_from_energy(strained_triangle, ratio * kSide, kTriangleArea);
    // Walls that stretch and, clamped at the joint, bend: r = (h/L)^2 is the ratio of the two stiffnesses of a half
    // wall.
    const double r = ratio * ratio;
    const double exact = 2.0 / kSqrt3 * kModulus * ratio * (1.0 + r) / (1.0 + r / 3.0);
    note_error(worst, modulus / exact, 1.0);
    if (ratio < 0.05) {
      EXPECT_NEAR(modulus / (2.0 / kSqrt3 * kModulus * ratio), 1.0, 1e-3);
    }
  }
  scenes::record_figure("triangles", worst, 1);
}

TEST(LatticeModuli, HexagonSpecimenWithFreeSidesApproachesTheLatticeAsOneOverItsColumns) {
  constexpr double kRatio = 0.1;
  std::vector<double> shortfall;
  for (const int columns : {4, 8, 16}) {
    const auto samples = scenes::run_frame(strained_hexagon_strip(kRatio * kSide, columns, kStrain));
    const double area = 1.5 * kSide * kSqrt3 * kSide * columns;
    const double modulus = 2.0 * samples.back().energies.elastic / (area * kStrain * kStrain);
    shortfall.push_back(1.0 - modulus / hexagon_modulus(kRatio));
  }
  for (std::size_t i = 1; i < shortfall.size(); ++i) {
    const double slope = std::log2(shortfall[i - 1] / shortfall[i]);
    scenes::record_figure("exponent " + std::to_string(i), slope, 4, {1.0, 0.1});
  }
}

/// Stress at a strain over that of a rigid-plastic hexagon whose walls have turned: (2/3) sigma_y (h/L)^2 at first,
/// more as the lever falls to L cos phi.
double collapse_ratio(int elements, const SectionSpec& section, double strain) {
  constexpr double kRatio = 0.05;
  constexpr double kYieldStress = 14.0;  // E / 5000: the collapse is complete before the cell has changed its shape
  const double thickness = kRatio * kSide;
  const auto samples = scenes::run_frame(crushed_hexagon(thickness, kYieldStress, 1.1 * strain, elements, section));
  const auto at = samples.size() * 10 / 11;
  const double way = samples[at + 5].watched.front().uy - samples[at - 5].watched.front().uy;
  const double force = (samples[at + 5].energies.external - samples[at - 5].energies.external) / way;
  const double angle = std::asin(0.5 + samples[at].watched.front().uy / (0.5 * kSide));
  const double collapse = 2.0 / 3.0 * kYieldStress * kRatio * kRatio;
  const double exact = collapse * std::cos(std::numbers::pi / 6.0) / std::cos(angle);
  return -force / (kSide * kSqrt3 / 2.0) / exact;
}

TEST(LatticeModuli, HexagonCollapsesPlasticallyAtItsHingesMoment) {
  for (const int elements : {1, 2, 4}) {
    const double ratio = collapse_ratio(elements, {}, 0.02);
    if (elements == 1) scenes::record_figure("excess in %", 100.0 * (ratio - 1.0), 2);
    EXPECT_NEAR(ratio, 1.0, 0.01) << elements << " elements in half a wall";
  }
}

TEST(LatticeModuli, OfThePapersElementsHexagonCollapsesAtWhatFibresAndTheirPlacesAdd) {
  SectionSpec section;
  section.formulation = SectionSpec::Formulation::displacement_based;
  section.depth_rule = SectionSpec::DepthRule::lobatto;
  for (const int elements : {1, 2, 4}) {
    const double ratio = collapse_ratio(elements, section, 0.02);
    // Six Lobatto fibres bear 1.0290 M_p; the first Gauss point stands 0.2113 of an element inside the joint.
    const double predicted = 1.0290 / (1.0 - 0.2113 / elements);
    if (elements == 1) scenes::record_figure("excess of the paper's elements in %", 100.0 * (ratio - 1.0), 2);
    EXPECT_NEAR(ratio / predicted, 1.0, 0.01) << elements << " elements in half a wall";
  }
}

}  // namespace
}  // namespace cellcrush
