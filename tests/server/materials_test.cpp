// The named materials: each can be crushed, tells its sources, and gives way to what a case says itself.
#include "translate/materials.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "programs/text_proto.h"
#include "server/small_case.h"
#include "translate/case_checker.h"
#include "translate/case_to_spec.h"
#include "translate/check_case.h"
#include "translate/spec_to_case.h"

namespace cellcrush {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

v1::Case case_of(const std::string& material) {
  v1::Case out = testing::small_case();
  out.clear_material();
  return testing::with_text(out, "material { " + material + " }");
}

TEST(NamedMaterials, EachCanBeCrushedAndTellsItsSources) {
  ASSERT_GE(translate::materials().materials_size(), 10);
  for (const v1::NamedMaterial& material : translate::materials().materials()) {
    const auto check = translate::check_case(case_of("named: \"" + material.name() + "\""), [] {});
    EXPECT_EQ(check.response.problems_size(), 0) << material.name() << ": " << check.response.ShortDebugString();
    for (const v1::Problem& note : check.response.notes()) {
      EXPECT_THAT(note.field(), Not(StartsWith("material."))) << material.name();
    }
    EXPECT_GE(material.sources_size(), 1) << material.name();
    EXPECT_THAT(material.numbers(), AllOf(HasSubstr("MPa"), HasSubstr("kg/m3"), Not(HasSubstr(", 0 kg/m3"))));
  }
}

TEST(NamedMaterials, FieldsBesideTheNameReplaceItsOwn) {
  const auto reading = translate::to_spec(case_of("named: \"AISI 4340\" yield_stress_mpa: 1000"));
  EXPECT_THAT(reading.problems, IsEmpty());
  EXPECT_EQ(reading.spec.material.yield_stress_mpa, 1000.0);
  EXPECT_EQ(reading.spec.material.ludwik_stress_mpa, 510.0);
  EXPECT_EQ(reading.spec.material.johnson_cook_coefficient, 0.014);
}

TEST(NamedMaterials, ATableBesideTheNameReplacesAllOfItsCurveOrRate) {
  const v1::Material out = translate::with_named(case_of(R"(named: "AISI 4340"
    hardening_table { plastic_strains: [0, 0.1] stresses_mpa: [800, 900] }
    rate_table { rates_per_s: [1, 100] factors: [1, 1.2] })")
                                                     .material());
  EXPECT_EQ(out.youngs_modulus_mpa(), 200000.0);
  EXPECT_FALSE(out.has_yield_stress_mpa());
  EXPECT_FALSE(out.has_ludwik_stress_mpa());
  EXPECT_FALSE(out.has_johnson_cook_coefficient());
  v1::Case of = case_of("");
  *of.mutable_material() = out;
  EXPECT_THAT(translate::CaseChecker().check(of).problems, IsEmpty());
}

TEST(NamedMaterials, AJobKeepsTheNumbersOfTheDayItWasMade) {
  const v1::Case kept = translate::with_named_materials(case_of("named: \"AISI 4340\" yield_stress_mpa: 1000"));
  EXPECT_EQ(kept.material().yield_stress_mpa(), 1000.0);
  EXPECT_EQ(kept.material().ludwik_stress_mpa(), 510.0);
  EXPECT_EQ(kept.material().named(), "AISI 4340");
  using google::protobuf::util::MessageDifferencer;
  EXPECT_TRUE(MessageDifferencer::Equals(translate::with_named_materials(kept), kept));
}

TEST(NamedMaterials, OneThatIsUnknownIsAProblemThatNamesThem) {
  const auto problems = translate::CaseChecker().check(case_of("named: \"4340\"")).problems;
  ASSERT_EQ(problems.size(), 1);
  EXPECT_EQ(problems[0].field(), "material.named");
  EXPECT_THAT(problems[0].remedy(), HasSubstr("\"AISI 4340\""));
}

TEST(NamedMaterials, TablesComeThroughBothWays) {
  v1::Case given = case_of(R"(youngs_modulus_mpa: 70000 density_kg_per_m3: 2700
    hardening_table { plastic_strains: [0, 0.1, 0.2] stresses_mpa: [76, 90, 95] beyond: POWER_LAW }
    rate_table { rates_per_s: [1, 100] factors: [1, 1.2] })");
  const auto reading = translate::to_spec(given);
  EXPECT_THAT(reading.problems, IsEmpty());
  EXPECT_EQ(reading.spec.material.yield_stress_mpa, 76.0);
  EXPECT_EQ(reading.spec.material.hardening_table.beyond, HardeningTable::Beyond::power_law);
  const v1::Material out = translate::to_case(reading.spec).material();
  using google::protobuf::util::MessageDifferencer;
  EXPECT_TRUE(MessageDifferencer::Equals(out.hardening_table(), given.material().hardening_table()));
  EXPECT_TRUE(MessageDifferencer::Equals(out.rate_table(), given.material().rate_table()));
}

TEST(NamedMaterials, ANameThatCountsForNothingIsNoted) {
  const auto notes_of = [](const std::string& more) {
    return translate::check_case(case_of("named: \"PLA\" density_kg_per_m3: 1240 " + more), [] {}).response.notes();
  };
  EXPECT_THAT(notes_of("yield_stress_mpa: 40"), IsEmpty());
  const auto notes = notes_of("yield_stress_mpa: 40 youngs_modulus_mpa: 3000");
  ASSERT_EQ(notes.size(), 1);
  EXPECT_EQ(notes[0].field(), "material.named");
}

/// A rate costs, and the forecast knows it.
TEST(NamedMaterials, AForecastCountsWhatTheLawCosts) {
  const std::string numbers = "youngs_modulus_mpa: 70000 yield_stress_mpa: 76 density_kg_per_m3: 2700 ";
  const auto steps_of = [&](const std::string& more) {
    return translate::CaseChecker().check(case_of(numbers + more)).element_steps;
  };
  EXPECT_GT(steps_of("hardening_modulus_mpa: 700"), steps_of("")) << "it is computed in double precision";
  EXPECT_LT(steps_of("hardening_modulus_mpa: 700"), 2 * steps_of(""));
  EXPECT_GT(steps_of("voce_stress_mpa: 10 voce_exponent: 10"), 2 * steps_of(""));
  EXPECT_GT(steps_of("johnson_cook_coefficient: 0.01"), 5 * steps_of(""));
}

}  // namespace
}  // namespace cellcrush
