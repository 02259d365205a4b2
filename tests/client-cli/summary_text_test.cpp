#include "terminal/summary_text.h"

#include <gmock/gmock.h>
#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include "columns/history_csv.h"
#include "expect_text.h"
#include "plots/job_curves.h"
#include "programs/text_proto.h"
#include "scripted_job.h"
#include "synthetic_crush.h"
#include "terminal/job_text.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SummaryText, HasBothShockTheoriesWithTheirErrorsFrontModeAndLedger) {
  const std::string text = summary_text(testing::make_job(v1::Job::SUCCEEDED), 120);
  EXPECT_THAT(text, ContainsRegex("3.41 MPa +3.37 MPa  shock theory \\(Eq. 51\\), 1.2 % lower"));
  EXPECT_THAT(text, ContainsRegex("3.43 MPa  shock theory with measured jumps \\(Eq. 52\\), 0.6 % higher"));
  EXPECT_THAT(text, HasSubstr("crush mode: layer by layer (I), first seen at strain 0.11\n"));
  EXPECT_THAT(text, ContainsRegex("strain +0.905"));
  EXPECT_THAT(text, ContainsRegex("0.391 +MPa, ahead of the front"));
  EXPECT_THAT(text, ContainsRegex("1.07 +from the undeformed wall volume"));
  EXPECT_THAT(text, ContainsRegex("contact damping +2.20 J +11.00 %"));
  EXPECT_THAT(text, Not(HasSubstr("initial energy")));
  EXPECT_THAT(text, Not(HasSubstr("plate stress difference")));
}

TEST(SummaryText, SaysHowSteadyASlowCrushWasAndNothingOfAFastOne) {
  auto job = from_text<v1::Job>(R"(words { plates: true } summary { quasi_static {
    plate_difference_relative: 0.0058 plate_difference_greatest: 0.021 kinetic_share: 0.0052 }
    inertia_share: 0.0047 })");
  const std::string slow = summary_text(job, 120);
  EXPECT_THAT(slow, ContainsRegex("plate stress difference beyond 5 % strain +0.58 %.*at most 2.10 %"));
  EXPECT_THAT(slow, ContainsRegex("inertia's share of the work +0.47 %"));
  job.mutable_summary()->mutable_quasi_static()->set_kinetic_share(0.9);
  EXPECT_THAT(summary_text(job, 120), Not(HasSubstr("plate stress difference")));
}

TEST(SummaryText, NamesALastingRiseThatIsNotDensification) {
  const auto job = from_text<v1::Job>(R"(words { plates: true } summary {
    other_rise: OTHER_RISE_SECOND_COLLAPSE other_rise_strain: 0.798 other_rise_words: "second collapse" })");
  const std::string text = summary_text(job, 120);
  EXPECT_THAT(text, ContainsRegex("densification strain +none"));
  EXPECT_THAT(text, ContainsRegex("other lasting rise of the stress +0.798 +second collapse"));
  EXPECT_THAT(summary_text(from_text<v1::Job>("words { plates: true } summary {}"), 120), Not(HasSubstr("rise")));
}

TEST(SummaryText, HasThePeakStressWithItsFilter) {
  const auto job = from_text<v1::Job>(R"(words { plates: true } summary {
    peak_stress_mpa: 5.25 peak_stress_strain: 0.012 peak_stress_window: 0.01 })");
  EXPECT_THAT(summary_text(job, 140),
              ContainsRegex("peak stress, impact plate +5.25 MPa +mean over 1 % strain, at 0.012"));
  EXPECT_THAT(summary_text(from_text<v1::Job>("words { plates: true } summary {}"), 140), Not(HasSubstr("peak")));
}

TEST(SummaryText, HasTheElasticModuliOfTheoryAndSaysWhereNoneApplies) {
  const auto job = from_text<v1::Job>(R"(words { plates: true } summary {
    plateau_window_high: 0.4 poissons_ratio: 0.25 theory { modulus_mpa: 101 poissons_ratio: 0.97 } })");
  const std::string text = summary_text(job, 140);
  EXPECT_THAT(text, ContainsRegex("computed +theory +no theory applies"));
  EXPECT_THAT(text, ContainsRegex("elastic modulus +101 MPa +E\\* of an endless lattice"));
  EXPECT_THAT(text, ContainsRegex("Poisson's ratio +0.25.* +0.97.* +secant to 0.4; theory: elastic"));
}

TEST(SummaryText, HasTheCrushForcesAndPoissonsRatioIfKnown) {
  const auto job = from_text<v1::Job>(R"(words { plates: true } summary {
    plateau_window_high: 0.4 poissons_ratio: -0.25
    crush_forces { mean_n: 120 peak_n: 480 efficiency: 0.25 stroke_mm: 33 specific_energy_j_per_g: 1.5 } })");
  const std::string text = summary_text(job, 140);
  EXPECT_THAT(text, ContainsRegex("mean crush force, impact plate +120 N +over 33.* mm; 0.25 of the peak"));
  EXPECT_THAT(text, ContainsRegex("specific energy absorbed +1.5.* J/g +over that travel"));
  EXPECT_THAT(text, ContainsRegex("Poisson's ratio +-0.25.* +secant, up to 0.4 strain"));
  const std::string without = summary_text(from_text<v1::Job>("words { plates: true } summary {}"), 140);
  EXPECT_THAT(without, Not(AnyOf(HasSubstr("crush force"), HasSubstr("specific energy"), HasSubstr("Poisson"))));
}

TEST(SummaryText, CountsRigidLinksIfThereAreAny) {
  EXPECT_THAT(summary_text(from_text<v1::Job>("summary { rigid_link_count: 6 }"), 140),
              ContainsRegex("rigid links +6 +beams too short to bend"));
  EXPECT_THAT(summary_text(from_text<v1::Job>("summary {}"), 140), Not(HasSubstr("rigid")));
}

TEST(SummaryText, CountsOverlapsBeforeLoadingIfThereAreAny) {
  EXPECT_THAT(summary_text(from_text<v1::Job>("summary { start_overlap_count: 1234 }"), 140),
              ContainsRegex("overlaps before loading +1,?234 +pairs of walls"));
  EXPECT_THAT(summary_text(from_text<v1::Job>("summary {}"), 140), Not(HasSubstr("overlaps")));
}

TEST(SummaryText, SaysWhereAndWhenAFibreWasStrainedMost) {
  auto job = from_text<v1::Job>(R"(words { plates: true } summary { fibre_strain {
    largest: 0.1234 wall: 17 x_mm: 3.5 y_mm: 12.25 nominal_strain: 0.31 time_s: 0.002 } })");
  EXPECT_THAT(summary_text(job, 140),
              ContainsRegex("largest fibre strain +12.34 % +wall 17 at .3.5, 12.2. mm, strain 0.31"));
  job.mutable_words()->set_plates(false);
  EXPECT_THAT(summary_text(job, 140), ContainsRegex("12.34 % .*mm, 0.002 s"));
  EXPECT_THAT(summary_text(from_text<v1::Job>("summary {}"), 140), Not(HasSubstr("fibre")));
}

TEST(SummaryText, NamesWarningsWithTheirRemedies) {
  EXPECT_THAT(summary_text(from_text<v1::Job>("summary {}"), 120), Not(HasSubstr("Warning")));
  const std::string text = summary_text(from_text<v1::Job>(R"(summary { warnings { kind: DEEP_PENETRATION
    message: "Walls have overlapped by 61 %." remedy: "Give a shorter numerics.time_step_s." } })"),
                                        120);
  EXPECT_THAT(text, HasSubstr("Warning (DEEP_PENETRATION): Walls have overlapped by 61 %.\n"));
  EXPECT_THAT(text, HasSubstr("Remedy: Give a shorter numerics.time_step_s.\n"));
}

TEST(SummaryText, SaysWhereTheLatticeIsClosedAndWhatIsTakenBefore) {
  v1::Job job = testing::make_job(v1::Job::SUCCEEDED);
  v1::Summary& summary = *job.mutable_summary();
  summary.set_valid_to_strain(0.31);
  summary.clear_plateau_stress_impact_mpa();
  summary.mutable_ledger()->set_work_external_mj(10.0 * summary.absorbed_energy_mj());
  const std::string text = summary_text(job, 120);
  EXPECT_THAT(text, ContainsRegex("at the impact plate +closed before"));
  EXPECT_THAT(text, ContainsRegex("valid to strain +0.310 +the lattice is closed from there on"));
  EXPECT_THAT(text, HasSubstr("energy absorbed to 31 % strain"));
  EXPECT_THAT(text, Not(HasSubstr("ended by itself")));
  summary.set_end(v1::Summary::END_CLOSED);
  summary.set_end_words("at strain 0.310, where the lattice is closed");
  EXPECT_THAT(summary_text(job, 120), HasSubstr("ended by itself: at strain 0.310, where the lattice is closed"));
}

TEST(SummaryText, FitsItsTerminal) {
  const v1::Job job = testing::make_job(v1::Job::SUCCEEDED);
  for (const int width : {60, 80, 100}) {
    testing::expect_no_wider(summary_text(job, width), width);
  }
}

TEST(SummaryText, SaysWhereTheoryDoesNotApply) {
  v1::Job job = testing::make_job(v1::Job::SUCCEEDED);
  EXPECT_THAT(summary_text(job, 80), Not(HasSubstr("Note:")));
  job.mutable_words()->set_theory_note("Squares are stretch-dominated.");
  EXPECT_THAT(summary_text(job, 80), HasSubstr("Note: Squares are stretch-dominated."));
}

TEST(SummaryText, OfAFrameIsTheLedgerWithWhatItStartedWith) {
  auto job = from_text<v1::Job>("summary { ledger { work_external_mj: 500 kinetic_mj: 2000 } }");
  const std::string text = summary_text(job, 120);
  EXPECT_THAT(text, ContainsRegex("initial energy +1.50 J +75.00 %"));
  EXPECT_THAT(text, Not(HasSubstr("plateau")));
  auto* ledger = job.mutable_summary()->mutable_ledger();
  ledger->GetReflection()->MutableUnknownFields(ledger)->AddFixed64(99, 1);
  EXPECT_THAT(summary_text(job, 120), ContainsRegex("initial energy less terms of a newer server +1.50 J"));
}

JobHistory history_with_damping() {
  JobHistory history{testing::make_job(v1::Job::SUCCEEDED), testing::synthetic_samples(50, 0.8)};
  for (v1::Sample& sample : history.samples) {
    sample.set_work_external_mj(1000.0 * sample.strain());
    sample.set_energy_plastic_mj(890.0 * sample.strain());
    sample.set_energy_damping_mj(110.0 * sample.strain());
    sample.set_energy_contact_damping_mj(100.0 * sample.strain());
  }
  return history;
}

TEST(EnergyChart, HasALineOfItsOwnForContactDampingAndNoneForWhatStaysZero) {
  const Chart chart = build_energy_chart(history_with_damping());
  std::vector<std::string> names;
  for (const Curve& curve : chart.curves) names.push_back(curve.name);
  EXPECT_THAT(names,
              ::testing::ElementsAre("work of the plates", "plastic", "contact damping", "mass damping", "residual"));
  EXPECT_NEAR(chart.curves[2].y.back(), 80.0, 1e-9) << chart.y.label;
  EXPECT_NEAR(chart.curves[3].y.back(), 8.0, 1e-9);
}

TEST(JobText, TellsWhereTheTimeWentWhereItIsKnown) {
  v1::Job job = testing::make_job(v1::Job::SUCCEEDED);
  const std::string text = description_text(job);
  EXPECT_THAT(text, HasSubstr("step time by stage  40.0 s"));
  EXPECT_THAT(text, HasSubstr("internal forces     30.0 s  75.0 %"));
  EXPECT_THAT(text, HasSubstr("find contacts       10.0 s  25.0 %"));
  job.mutable_summary()->clear_stage_times();
  EXPECT_EQ(description_text(job).find("by stage"), std::string::npos);
}

TEST(JobChart, HasALevelOfEquation52) {
  const Chart chart = build_job_chart(history_with_damping());
  EXPECT_EQ(
      std::count_if(chart.curves.begin(), chart.curves.end(),
                    [](const Curve& curve) { return curve.name == "shock theory, measured jumps (Eq. 52): 3.43 MPa"; }),
      1);
}

TEST(HistoryCsv, LeavesTheFrontsCellsEmptyWhereThereIsNone) {
  google::protobuf::RepeatedPtrField<v1::Sample> samples;
  samples.Add();
  samples.Add()->mutable_front()->set_position_mm(12.5);
  const std::string text = history_csv(samples);
  EXPECT_THAT(
      text, HasSubstr("energy_contact_damping_mj,deepest_penetration,solid_fraction,collapsed_fraction,"
                      "largest_fibre_strain,peak_stress_mpa,peak_stress_strain,lateral_strain,absorption_efficiency,"
                      "energy_fracture_mj,front_position_mm,front_strain_behind"));
  EXPECT_THAT(text, HasSubstr("front_wall_fraction_behind,step,contact_count,most_strained_wall,break_count\n"));
  EXPECT_THAT(text, HasSubstr(",0,0,,,,,,,,0,0,0,0\n"));
  EXPECT_THAT(text, HasSubstr(",0,0,12.5,0,0,0,0,0,0,0,0,0,0\n"));
}

}  // namespace
}  // namespace cellcrush::client
