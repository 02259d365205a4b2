#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/reference/bilinear_elastica.h"
#include "scenes/presets.h"
#include "validation/crush_run.h"

namespace cellcrush {
namespace {

using validation::CrushRun;

/// An example: its preset, walls in mm, and what two other programs of the paper's method have with two of the paper's
/// elements a wall, MPa.
struct Example {
  const char* preset;
  double side;
  double thickness;
  double limit_stress;
  double limit_tolerance;  // relative
  double plateau_stress;
};
constexpr Example kDimensions1 = {"papka-kyriakides-1", 5.51, 0.1448, 0.142, 0.06, 0.121};
constexpr Example kDimensions2 = {"papka-kyriakides-2", 5.49, 0.1194, 0.094, 0.05, 0.078};

SectionSpec papers_elements() {
  SectionSpec section;
  section.formulation = SectionSpec::Formulation::displacement_based;
  section.depth_rule = SectionSpec::DepthRule::lobatto;
  return section;
}

CrushRun crush(const Example& example, const SectionSpec& section, const Imperfection& imperfection = {}) {
  SceneSpec spec = scenes::preset(example.preset);
  spec.section = section;
  spec.imperfection = imperfection;
  // The presets end at 80 %, where the densified stress is not yet a third above the plateau of every one.
  spec.loading.end_strain = 0.85;
  CrushRun run = validation::run_crush(spec);
  EXPECT_EQ(run.status.kind, RunStatus::Kind::finished) << run.status.message;
  return run;
}

/// Slow enough: the plates bear the same, and the motion holds next to nothing of the work.
void expect_quasi_static(const CrushRun& run) {
  EXPECT_LT(run.plate_force_difference, 0.015);
  EXPECT_LT(run.kinetic_over_work, 0.01);
  EXPECT_LT(run.kinetic_over_plastic_flowing, 0.01);
  EXPECT_LT(run.summary.energy_error_relative, 0.01);
}

/// Plateau and densification are those of the other programs. Of the default elements the onset scatters more than
/// theirs: seeds of 0.01 mm put that of dimensions 2 at 0.68 to 0.77.
void expect_course(const CrushRun& run, const Example& example, double onset_tolerance) {
  EXPECT_NEAR(run.summary.plateau_stress_impact.value_or(0.0) / example.plateau_stress, 1.0, 0.06);
  EXPECT_NEAR(run.summary.plateau_stress_support.value_or(0.0) / example.plateau_stress, 1.0, 0.06);
  EXPECT_NEAR(run.summary.densification_strain.value_or(0.0), 0.73, onset_tolerance);
}

/// Up to the limit all rows are crushed alike, so that its stress is that of one wall, exact, at the same strain; the
/// free sides take off little.
void expect_limit_of_the_exact_wall(const CrushRun& run, const Example& example) {
  const reference::BilinearSection section = {example.thickness, 69000.0, 690.0, 292.0};
  const double angle = std::numbers::pi / 6.0;
  const double load =
      reference::load_of_pushed_wall(section, example.side, angle, run.limit.strain * 1.5 * example.side);
  const double stress = load / (example.side * std::cos(angle));
  EXPECT_NEAR(run.limit.stress / stress, 1.0, 0.03);
}

void expect_limit_of_other_programs(const CrushRun& run, const Example& example) {
  EXPECT_NEAR(run.limit.stress / example.limit_stress, 1.0, example.limit_tolerance);
  EXPECT_GT(run.limit.strain, 0.075);
  EXPECT_LT(run.limit.strain, 0.12);
}

TEST(Example1, Dimensions1OfThePapersElementsCollapsesAsInOtherPrograms) {
  const CrushRun run = crush(kDimensions1, papers_elements());
  expect_quasi_static(run);
  expect_limit_of_other_programs(run, kDimensions1);
  EXPECT_LT(run.limit.least_after, 0.90 * run.limit.stress);
  expect_course(run, kDimensions1, 0.04);
}

TEST(Example1, Dimensions2OfThePapersElementsCollapsesAsInOtherPrograms) {
  const CrushRun run = crush(kDimensions2, papers_elements());
  expect_quasi_static(run);
  expect_limit_of_other_programs(run, kDimensions2);
  expect_course(run, kDimensions2, 0.04);
}

/// The perfect lattice stays even until round-off or the plates' friction part it, which no specimen does: its stress
/// falls after the limit by 6 or by 11 %, that of seeds of this amplitude by 10 to 12 %.
constexpr Imperfection kSmall = {0.01, 1, 0.0};

TEST(Example1, Dimensions1OfDefaultElementsCollapsesAtTheStressOfItsExactWall) {
  const CrushRun run = crush(kDimensions1, {}, kSmall);
  expect_quasi_static(run);
  expect_limit_of_the_exact_wall(run, kDimensions1);
  EXPECT_LT(run.limit.least_after, 0.92 * run.limit.stress);
  expect_course(run, kDimensions1, 0.06);
}

TEST(Example1, Dimensions2OfDefaultElementsCollapsesAtTheStressOfItsExactWall) {
  const CrushRun run = crush(kDimensions2, {}, kSmall);
  expect_quasi_static(run);
  expect_limit_of_the_exact_wall(run, kDimensions2);
  expect_course(run, kDimensions2, 0.06);
}

}  // namespace
}  // namespace cellcrush
