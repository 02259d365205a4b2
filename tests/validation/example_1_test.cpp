#include <gtest/gtest.h>

#include <string>

#include "cellcrush/presets.h"
#include "validation/crush_run.h"

namespace cellcrush {
namespace {

using validation::CrushRun;

/// What two independent programs have for an example, MPa, both with two elements a wall.
struct Reference {
  const char* preset;
  double limit_stress;
  double limit_tolerance;  // relative
  double plateau_stress;
};
constexpr Reference kDimensions1 = {"papka-kyriakides-1", 0.142, 0.06, 0.121};
constexpr Reference kDimensions2 = {"papka-kyriakides-2", 0.094, 0.05, 0.078};

void record(const std::string& name, double value) { testing::Test::RecordProperty(name, std::to_string(value)); }

CrushRun crush(const Reference& reference, const SectionSpec& section) {
  SceneSpec spec = find_preset(reference.preset)->spec;
  spec.section = section;
  CrushRun run = validation::run_crush(spec);
  EXPECT_EQ(run.status.kind, RunStatus::Kind::finished) << run.status.message;
  record("limit_stress", run.limit.stress);
  record("limit_strain", run.limit.strain);
  record("least_stress_after_limit", run.limit.least_after);
  record("plateau_stress_impact", run.summary.plateau_stress_impact.value_or(0.0));
  record("plateau_stress_support", run.summary.plateau_stress_support.value_or(0.0));
  record("densification_strain", run.summary.densification_strain.value_or(0.0));
  record("plate_force_difference", run.plate_force_difference);
  record("kinetic_over_work", run.kinetic_over_work);
  record("kinetic_over_plastic", run.kinetic_over_plastic);
  record("kinetic_over_plastic_flowing", run.kinetic_over_plastic_flowing);
  record("energy_error_relative", run.summary.energy_error_relative);
  return run;
}

/// Slow enough: the plates bear the same, and the motion holds next to nothing of the work.
void expect_quasi_static(const CrushRun& run) {
  EXPECT_LT(run.plate_force_difference, 0.015);
  EXPECT_LT(run.kinetic_over_work, 0.01);
  EXPECT_LT(run.kinetic_over_plastic_flowing, 0.01);
  EXPECT_LT(run.summary.energy_error_relative, 0.01);
}

/// The limit stands at 7.5 to 12 % strain, and rows collapse after it.
void expect_limit(const CrushRun& run, const Reference& reference) {
  EXPECT_NEAR(run.limit.stress / reference.limit_stress, 1.0, reference.limit_tolerance);
  EXPECT_GT(run.limit.strain, 0.075);
  EXPECT_LT(run.limit.strain, 0.12);
}

void expect_plateau(const CrushRun& run, const Reference& reference) {
  EXPECT_NEAR(run.summary.plateau_stress_impact.value_or(0.0) / reference.plateau_stress, 1.0, 0.06);
  EXPECT_NEAR(run.summary.plateau_stress_support.value_or(0.0) / reference.plateau_stress, 1.0, 0.06);
  EXPECT_NEAR(run.summary.densification_strain.value_or(0.0), 0.73, 0.04);
}

SectionSpec papers_section() {
  SectionSpec section;
  section.formulation = SectionSpec::Formulation::displacement_based;
  section.depth_rule = SectionSpec::DepthRule::lobatto;
  section.area_rule = SectionSpec::AreaRule::constant_area;
  return section;
}

TEST(Example1, Dimensions1OfThePapersElementsCollapsesAsInOtherPrograms) {
  const CrushRun run = crush(kDimensions1, papers_section());
  expect_quasi_static(run);
  expect_limit(run, kDimensions1);
  EXPECT_LT(run.limit.least_after, 0.90 * run.limit.stress);
  expect_plateau(run, kDimensions1);
}

TEST(Example1, Dimensions2OfThePapersElementsCollapsesAsInOtherPrograms) {
  const CrushRun run = crush(kDimensions2, papers_section());
  expect_quasi_static(run);
  expect_limit(run, kDimensions2);
  expect_plateau(run, kDimensions2);
}

TEST(Example1, Dimensions1CollapsesAsInOtherPrograms) {
  const CrushRun run = crush(kDimensions1, {});
  expect_quasi_static(run);
  expect_limit(run, kDimensions1);
  EXPECT_LT(run.limit.least_after, 0.90 * run.limit.stress);
  expect_plateau(run, kDimensions1);
}

TEST(Example1, Dimensions2CollapsesAsInOtherPrograms) {
  const CrushRun run = crush(kDimensions2, {});
  expect_quasi_static(run);
  expect_limit(run, kDimensions2);
  expect_plateau(run, kDimensions2);
}

}  // namespace
}  // namespace cellcrush
