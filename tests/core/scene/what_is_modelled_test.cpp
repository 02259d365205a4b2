#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// As in `check` and result.h5: every shortcut with its reason, and what was asked for as such.
TEST(WhatIsModelled, SaysWhyEachShortcutIsTaken) {
  const SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto said = facts_of(*scenes::build(spec)).modelled;
  EXPECT_THAT(said, Contains(HasSubstr("by the faces of the lattice: it is connected, planar and closed")));
  EXPECT_THAT(said, Contains(HasSubstr("perfectly plastic; each stores only its stress")));
  EXPECT_THAT(said, Contains(HasSubstr("in single precision, which halves the memory")));
  EXPECT_THAT(said, Contains(HasSubstr("Plates: rigid, unilateral, not meshed")));
  EXPECT_THAT(said, Contains(HasSubstr("Symmetry: not used")));
  EXPECT_THAT(said, Not(Contains(HasSubstr("as requested"))));
}

TEST(WhatIsModelled, SaysWhatWasAskedFor) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.contact.search = ContactSpec::Search::buckets;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.numerics.time_step_s = 1e-8;
  spec.material.hardening_modulus_mpa = 1000.0;
  const auto said = facts_of(*scenes::build(spec)).modelled;
  EXPECT_THAT(said, Contains("Contacts are searched by buckets in space, as requested (contact.search)."));
  EXPECT_THAT(said, Contains("Step: as requested (numerics.time_step_s)."));
  EXPECT_THAT(said,
              Contains(HasSubstr("each stores its back stress and accumulated plastic strain, in double precision")));
}

// Beyond 1 / sqrt(2) of the stable step force-based elements can vibrate in cycles of four steps.
TEST(WhatIsModelled, WarnsOfALongStepOfForceBasedElements) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto warning = Contains(HasSubstr("more than 0.7 of the stability limit"));
  const double stable = scenes::build(spec)->stable_step;
  spec.numerics.time_step_s = 0.7 * stable;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, Not(warning));
  spec.numerics.time_step_s = 0.72 * stable;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, warning);
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  spec.numerics.time_step_s = 0.0;
  spec.numerics.time_step_s = 0.9 * scenes::build(spec)->stable_step;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, Not(warning));
}

TEST(WhatIsModelled, SaysThatSlowLoadingNeedsDoublePrecision) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto said = Contains(HasSubstr("rounding errors of slow loading add up"));
  spec.loading.speed_m_per_s = 0.1;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, Not(said));
  spec.loading.speed_m_per_s = 0.001;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, said);
}

// A formulation that is changed alone keeps the points of the other.
TEST(WhatIsModelled, WarnsOfPointsThatAreComputedOneByOne) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto warning = Contains(HasSubstr("these are computed one element at a time"));
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, Not(warning));
  spec.section.formulation = SectionSpec::Formulation::displacement_based;
  spec.section.axial_points = 4;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, warning);
  spec.section.axial_points = 2;
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, Not(warning));
}

TEST(WhatIsModelled, NamesTheBoundOfTheStep) {
  const auto step_of = [](const char* preset, double speed) {
    SceneSpec spec = scenes::preset(preset);
    spec.loading.speed_m_per_s = speed;
    for (const std::string& line : facts_of(*scenes::build(spec)).modelled) {
      if (line.rfind("Step: ", 0) == 0) {
        return line;
      }
    }
    return std::string();
  };
  EXPECT_THAT(step_of("type-i", 10.0), HasSubstr("lightest, stiffest element"));
  EXPECT_THAT(step_of("type-i", 400.0), HasSubstr("plate moves by 0.08"));
  EXPECT_THAT(step_of("type-iii-as-counted", 10.0), HasSubstr("stacked along the crush"));
}

}  // namespace
}  // namespace cellcrush
