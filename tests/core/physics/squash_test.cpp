#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scene/time_step.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/kernels.h"

namespace cellcrush {
namespace {

constexpr double kYieldStress = 76.0;
constexpr double kSide = 4.0;
constexpr double kThickness = 0.3464;

/// A wall of two elements, held straight, that is squashed to a share of its length, slowly beside elastic waves.
SceneSpec squashed_wall(SectionSpec::AreaRule rule, double share) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kSide, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, 2)};
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  const double end = 2e-4;
  frame.motions = {{1, FrameLattice::Component::x, {{0.0, 0.0}, {end, -(1.0 - share) * kSide}}}};
  frame.watched_nodes = {1};
  frame.end_time_s = end;
  SceneSpec spec = scenes::elastic_frame(frame);
  spec.material.youngs_modulus_mpa = 69000.0;
  spec.material.yield_stress_mpa = kYieldStress;
  spec.material.density_kg_per_m3 = 2700.0;
  spec.numerics.mass_damping_per_s = 1e5;
  spec.section.area_rule = rule;
  // The last bits of single precision are enough to buckle a straight wall; here it is to stay straight.
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  return spec;
}

struct Squash {
  double shortest = 1.0;  ///< least length of an element over its undeformed one
  double plastic = 0.0;   ///< N mm
  double residual = 0.0;  ///< share of the work
};

Squash squash(SectionSpec::AreaRule rule, double share) {
  Simulation simulation(scenes::build(squashed_wall(rule, share)));
  Squash result;
  Sample sample;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(2);
    sample = simulation.take_sample();
    for (std::size_t e = 0; e < simulation.scene().element_count(); ++e) {
      result.shortest =
          std::min(result.shortest, simulation.state().length[e] / simulation.scene().walls.undeformed_length.front());
    }
  }
  result.plastic = sample.energies.plastic;
  result.residual = sample.energies.residual / sample.energies.external;
  return result;
}

TEST(SquashedWall, AtConstantVolumeShortensEvenlyAndTakesTheWorkOfItsVolume) {
  double worst_work = 0.0;
  double worst_residual = 0.0;
  for (const double share : {0.7, 0.5, 0.3}) {
    const Squash result = squash(SectionSpec::AreaRule::constant_volume, share);
    EXPECT_NEAR(result.shortest, share, 0.02);
    const double work = kSide * kThickness * kYieldStress * std::log(1.0 / share);
    EXPECT_NEAR(result.plastic, work, 0.02 * work) << share;
    EXPECT_LT(std::abs(result.residual), 0.01) << share;
    worst_work = std::max(worst_work, std::abs(result.plastic / work - 1.0));
    worst_residual = std::max(worst_residual, std::abs(result.residual));
  }
  scenes::record_figure("worst work in %", 100.0 * worst_work, 2);
  scenes::record_figure("residual in %", 100.0 * worst_residual, 2);
}

// The energy that the bounded modulus stores at a given stress grows as the wall shortens: by about a third of the
// plastic work at a tenth of the length. The axial force has its derivative by the length (E5g), so the ledger closes.
TEST(SquashedWall, SquashedToATenthTheBoundedModulusLeavesTheLedgerClosed) {
  const Squash result = squash(SectionSpec::AreaRule::constant_volume, 0.1);
  EXPECT_NEAR(result.shortest, 0.1, 0.01);
  EXPECT_LT(std::abs(result.residual), 0.005);
  scenes::record_figure("residual in %", 100.0 * result.residual, 2);
}

// The paper's constant area gives no resistance that grows: one of two elements takes all the shortening, until it has
// hardly any length left.
TEST(SquashedWall, AtConstantAreaOneElementIsSquashedToNothing) {
  EXPECT_LT(squash(SectionSpec::AreaRule::constant_area, 0.3).shortest, 0.06);
}

// The stiffness that is left makes the greatest frequency of a squashed element or pair that of one at 0.95 of its
// length.
TEST(SquashedWall, VibratesNoFasterThanTheUndeformedOne) {
  const Material material = {69000.0, kYieldStress, 0.0, 1.0, 2.7e-9};
  const double undeformed = 2.0;
  for (const bool in_pairs : {false, true}) {
    const auto step_of = in_pairs ? stable_step_of_pair : stable_step_of_element;
    for (const MassScaling& scaling : {MassScaling{}, MassScaling{1.0, 2.5}}) {
      for (const double thickness : {0.1 * undeformed, 0.5 * undeformed, 1.6 * undeformed}) {
        const double bound = step_of(0.95 * undeformed, thickness, material, scaling);
        for (const double share : {0.9, 0.5, 0.2, 0.05}) {
          const double length = share * undeformed;
          // Mass and volume stay, and so does the density.
          Material squashed = material;
          squashed.youngs_modulus *= scenes::modulus_share(length, undeformed, thickness, in_pairs, scaling.rotary);
          // The turn of a node is stiffer by the square of the thickness (E5f), the rotary inertia stays.
          const double growth = std::clamp(std::sqrt(1.0 / share) - 0.1, 1.0, 2.0);
          const double step = step_of(length, thickness, squashed, scaling) / growth;
          SCOPED_TRACE(testing::Message() << (in_pairs ? "pair, h = " : "element, h = ") << thickness
                                          << " mm, l / l_0 = " << share << ", q = " << scaling.rotary);
          EXPECT_GE(step, (1.0 - 1e-9) * bound);
          if (scaling.rotary == 1.0) {  // above, the axial mode may bound the step
            EXPECT_NEAR(step, bound, 1e-9 * bound);
          }
        }
      }
    }
  }
}

TEST(PlaneStrain, WallIsStifferAndYieldsLater) {
  SceneSpec spec = squashed_wall(SectionSpec::AreaRule::constant_volume, 0.5);
  spec.material.plane = MaterialSpec::Plane::strain;
  spec.material.poissons_ratio = 0.3;
  const auto scene = scenes::build(spec);
  EXPECT_NEAR(scene->materials[0].youngs_modulus, 69000.0 / 0.91, 1e-6);
  EXPECT_NEAR(scene->materials[0].yield_stress, kYieldStress * 1.1547, 0.001);
  spec.material.poissons_ratio = 0.6;
  const Problems problems = build_scene(spec).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "material.poissons_ratio");
}

}  // namespace
}  // namespace cellcrush
