#include "terminal/sweep_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "columns/sweep_csv.h"
#include "expect_text.h"
#include "programs/text_proto.h"
#include "results/sweep_results.h"
#include "sweep_samples.h"
#include "terminal/job_list_text.h"
#include "terminal/sweep_text.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using testing::expect_no_wider;
using testing::expect_parts_in;
using ::testing::HasSubstr;
using testing::lines_of;
using testing::make_averaged_table;
using testing::make_job;
using testing::make_table;
using ::testing::Not;

TEST(SweepTable, IsAlignedAndFollowedByTheFit) {
  const std::string text = sweep_table_text(make_table(4), "", kTableDigits, 120);
  const auto lines = lines_of(text);
  ASSERT_GE(lines.size(), 8U);
  EXPECT_EQ(lines[0].find("speed  job     plateau"), 0U) << text;
  EXPECT_EQ(lines[4].find("   50  jobs/1     1.00"), 0U) << text;
  // The cells of a column end where its heading does.
  const std::size_t impact = lines[1].find("impact") + 6;
  EXPECT_EQ(lines[4].substr(impact - 4, 4), "1.00") << text;
  EXPECT_EQ(lines[7].substr(impact - 4, 4), "12.3") << text;
  expect_parts_in(text, {"0.440", "12.3", "0.301", "1.21", "from 20 to 40 % strain",
                         "least-squares fit: 0.25 + 0.0001 V + 0.0003 V^2",
                         "shock theory (Eq. 51): 0.301 + 0.00031 V^2", "state SUCCEEDED"});
}

TEST(SweepTable, FitsItsTerminalAndSaysOnceWhatDoesNotVary) {
  for (const int width : {60, 80, 100, 200}) {
    expect_no_wider(sweep_table_text(make_table(4), "", kTableDigits, width), width);
  }
  const std::string text = sweep_table_text(make_table(4), "", kTableDigits, 200);
  EXPECT_THAT(text, HasSubstr("The same in all rows: state SUCCEEDED; plateau support plate 0.440 MPa"));
  EXPECT_THAT(text, HasSubstr("layer by layer (I)"));
}

TEST(SweepTable, HasAsManyDigitsAsAskedAndSaysWhereTheoryDoesNotApply) {
  const std::string text = sweep_table_text(make_table(4), "Squares are stretch-dominated.", 6);
  EXPECT_THAT(text, HasSubstr("12.2700"));
  EXPECT_THAT(text, HasSubstr("Note: Squares are stretch-dominated"));
}

TEST(JobList, ShowsWhatDiffersBetweenJobsOfATitleAndFitsItsTerminal) {
  std::vector<v1::Job> jobs;
  for (const double speed : {50.0, 100.0, 200.0}) {
    v1::Job& job = jobs.emplace_back(make_job(static_cast<int>(jobs.size()), v1::Job::SUCCEEDED, speed));
    job.mutable_case_()->set_title(
        "7 rows of 20 and 19 hexagons, crushed along the rows at 100 m/s, "
        "loading.speed_m_per_s = " +
        std::to_string(speed));
  }
  const auto lines = lines_of(job_list_text(jobs, 80));
  EXPECT_EQ(lines[0], "NAME    STATE      speed");
  EXPECT_EQ(lines[2], "7 rows of 20 and 19 hexagons, crushed along the rows at 100 m/s");
  EXPECT_EQ(lines[3], "jobs/0  SUCCEEDED     50");
  EXPECT_EQ(lines[5], "jobs/2  SUCCEEDED    200");
  jobs[2].mutable_case_()->set_title("Another");
  for (const int width : {30, 40, 80}) {
    expect_no_wider(job_list_text(jobs, width), width);
  }
}

TEST(SweepTable, WithFewerThanThreeResultsThereIsNoFitAndFailuresSayWhy) {
  const std::string text = sweep_table_text(make_table(2), "", kTableDigits, 120);
  EXPECT_THAT(text, Not(HasSubstr("least-squares")));
  EXPECT_THAT(text, HasSubstr("jobs/3 FAILED (ENERGY_BALANCE): the ledger opened"));
  const std::string three = sweep_table_text(make_table(3), "", kTableDigits, 120);
  EXPECT_THAT(three, Not(HasSubstr("least-squares")));
  EXPECT_THAT(three, Not(HasSubstr("largest residual")));
  EXPECT_THAT(three, HasSubstr("quadratic through the three points: 0.25 + 0.0001 V + 0.0003 V^2"));
  v1::SweepTable depth = make_table(4);
  depth.set_fields(0, "depth_mm");
  EXPECT_THAT(sweep_table_text(depth, ""), Not(HasSubstr("least-squares")));
}

TEST(SweepTable, AsCsvHasAllDigitsAndEmptyCells) {
  v1::SweepTable table = make_table(1);
  v1::Summary& summary = *table.mutable_rows(0)->mutable_result()->mutable_summary();
  summary.set_valid_to_strain(0.86);
  summary.set_poissons_ratio(-0.25);
  *summary.mutable_crush_forces() = from_text<v1::CrushForces>("mean_n: 80 peak_n: 200 efficiency: 0.4");
  const auto lines = lines_of(sweep_table_csv(table));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0],
            "loading.speed_m_per_s,job,state,plateau_stress_impact_mpa,plateau_stress_support_mpa,"
            "plateau_stress_to_densification_mpa,densification_strain,absorbed_energy_mj,gibson_ashby_mpa,shock_mpa,"
            "front_shock_mpa,front_strain_behind,energy_error_relative,valid_to_strain,crush_mode,"
            "solid_fraction_at_densification,crush_forces_mean_n,crush_forces_peak_n,crush_forces_efficiency,"
            "crush_forces_specific_energy_j_per_g,poissons_ratio");
  EXPECT_EQ(lines[1].find("50,jobs/1,SUCCEEDED,1.005,0.44,,,12345,0.301,"), 0U) << lines[1];
  EXPECT_THAT(lines[1], HasSubstr(",0.0121,0.86,V,,80,200,0.4,0,-0.25"));
  EXPECT_EQ(lines[2], "100,jobs/2,FAILED,,,,,,,,,,,,,,,,,,");
}

TEST(SweepTable, ShowsMeansOverTheSeedsWithTheirIntervalsUnlessEachJobIsWanted) {
  const v1::SweepTable table = make_averaged_table();
  const std::string text = sweep_table_text(shown_table(table, false), "", kTableDigits, 120);
  // Stresses below 0.1 MPa are in kPa, values in six digits, and an interval of round-off is none.
  expect_parts_in(text, {"  0.3       3  34.1 ± 4.9  0.658 (1 of 3)  V-shaped band (V), 2 of 3\n",
                         "    2  2 of 3  99.1 ± 4.9  0.658 (1 of 2)  V-shaped band (V)\n", "support plate 25.0 kPa",
                         "--each says which", "95 % confidence interval", "1 run FAILED", "2 runs with warnings"});
  EXPECT_THAT(text, Not(HasSubstr("seed ")));
  EXPECT_THAT(sweep_table_text(shown_table(table, true), ""), HasSubstr("jobs/1"));
}

TEST(SweepTable, NamesTheJobsWithWarnings) {
  auto table = make_averaged_table();
  auto& summary = *table.mutable_rows(0)->mutable_result()->mutable_summary();
  for (const auto kind : {v1::Warning::BORDERS_NEAR, v1::Warning::WALLS_NECK, v1::Warning::WALLS_NECK})
    summary.add_warnings()->set_kind(kind);
  EXPECT_THAT(sweep_table_text(shown_table(table, true), ""), HasSubstr("prints them):\n  jobs/1: WALLS_NECK\n"));
}

TEST(SweepTable, AsCsvOfMeansHasIntervalsAndCounts) {
  const auto lines = lines_of(sweep_table_csv(shown_table(make_averaged_table(), false)));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].find("loading.speed_m_per_s,jobs,succeeded,failed,plateau_stress_impact_mpa,"
                          "plateau_stress_impact_mpa_ci95,plateau_stress_impact_mpa_count,"),
            0U);
  EXPECT_EQ(lines[1].find("0.30000000000000004,3,3,0,0.0341,0.0049,3,0.025,"), 0U) << lines[1];
  EXPECT_THAT(lines[2], HasSubstr(",V,2,"));
}

TEST(SweepText, DescribesTheAxesAndTheJobs) {
  const auto sweep = from_text<v1::Sweep>(R"(name: "sweeps/3"
    axes { field: "loading.speed_m_per_s" list { values: [50, 100] } }
    axes { field: "lattice.imperfection.seed" seed_count: 8 }
    jobs: ["jobs/1", "jobs/2"] state_counts { key: "SUCCEEDED" value: 2 } labels { key: "who" value: "me" })");
  const std::string text = description_text(sweep);
  expect_parts_in(text, {"sweeps/3: 2 jobs, 2 SUCCEEDED\n", "over loading.speed_m_per_s      50, 100\n",
                         "over lattice.imperfection.seed  1 to 8\n", "jobs/1, jobs/2\n", "who=me\n"});
  EXPECT_THAT(sweep_list_text({sweep}), HasSubstr("LABELS"));
  EXPECT_EQ(sweep_list_text({}), "no sweeps\n");
}

}  // namespace
}  // namespace cellcrush::client
