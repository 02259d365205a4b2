#include "terminal/sweep_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "columns/sweep_csv.h"
#include "command_error.h"
#include "expect_text.h"
#include "plots/job_picture.h"
#include "plots/sweep_curves.h"
#include "plots/sweep_map.h"
#include "programs/text_proto.h"
#include "results/sweep_results.h"
#include "terminal/job_list_text.h"
#include "terminal/sweep_chart_text.h"
#include "terminal/sweep_progress.h"
#include "terminal/sweep_table.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using cellcrush::testing::with_text;
using testing::expect_no_wider;
using testing::expect_parts_in;
using ::testing::HasSubstr;
using ::testing::Not;

v1::Job make_job(int number, v1::Job::State state, double speed) {
  auto job = from_text<v1::Job>("words { plates: true }");
  job.set_name("jobs/" + std::to_string(number));
  job.set_state(state);
  job.mutable_case_()->mutable_loading()->set_speed_m_per_s(speed);
  const bool has_begun = state == v1::Job::RUNNING || state == v1::Job::SUCCEEDED;
  return has_begun ? with_text(job, "progress { fraction: 0.473 strain: 0.31 plateau_so_far_mpa: 3.39 }") : job;
}

v1::SweepTable make_table(int succeeded) {
  v1::SweepTable table;
  table.add_fields("loading.speed_m_per_s");
  for (int i = 1; i <= 4; ++i) {
    const double speed = 50.0 * i;
    auto& row = *table.add_rows();
    row.add_values(speed);
    *row.mutable_result() = make_job(i, i <= succeeded ? v1::Job::SUCCEEDED : v1::Job::FAILED, speed);
    row.set_job(row.result().name());
    if (i > succeeded) {
      row.mutable_result()->set_cause(v1::Job::ENERGY_BALANCE);
      row.mutable_result()->set_cause_message("the ledger opened");
      continue;
    }
    v1::Summary& summary = *row.mutable_result()->mutable_summary();
    summary = from_text<v1::Summary>(
        R"(step_count: 1000 plateau_window_low: 0.2 plateau_window_high: 0.4 plateau_stress_support_mpa: 0.44
           absorbed_energy_mj: 12345 energy_error_relative: 0.0121 theory { gibson_ashby_mpa: 0.301 })");
    summary.set_plateau_stress_impact_mpa(0.25 + 1e-4 * speed + 3e-4 * speed * speed);
    summary.set_crush_mode(i == 1 ? v1::Summary::CRUSH_MODE_V : v1::Summary::CRUSH_MODE_I);
    summary.set_crush_mode_words(i == 1 ? "V-shaped band (V)" : "layer by layer (I)");
    if (i > 1) summary.mutable_front()->set_shock_mpa(0.27 + 2.9e-4 * speed * speed);
    summary.mutable_theory()->set_shock_mpa(0.301 + 3.1e-4 * speed * speed);
  }
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(SweepChartText, DrawsThePlateausAndTheTheoryOverTheSpeed) {
  const std::string text = sweep_chart_text(make_table(4), false, 80);
  const auto lines = lines_of(text);
  ASSERT_EQ(lines.size(), 19U) << text;
  EXPECT_EQ(lines[1], "plateau stress at the impact plate (MPa) against speed (m/s)");
  // 12.3 MPa at 200 m/s stand at the top right, 1.0 at 50 m/s a quarter across and near the bottom.
  const auto place_of = [](const std::string& line) { return line.find('o') - line.find_first_of("|+") - 1; };
  EXPECT_EQ(place_of(lines[3]), 63U) << text;
  EXPECT_EQ(place_of(lines[14]), 16U) << text;
  EXPECT_EQ(std::count(text.begin() + static_cast<std::ptrdiff_t>(text.find(lines[2])), text.end(), 'o'), 6) << text;
  EXPECT_EQ(lines[5].substr(0, 6), "  10 +") << text;
  EXPECT_THAT(lines[17], HasSubstr("200"));
  EXPECT_EQ(lines[18], "  . shock theory (Eq. 51)");
  for (const auto& line : lines) EXPECT_LE(line.size(), 79U);
}

TEST(SweepChartText, IsLeftOutWhereThereAreNoTwoPoints) {
  EXPECT_EQ(sweep_chart_text(make_table(1), true, 80), "");
  EXPECT_EQ(sweep_chart_text({}, true, 80), "");
}

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
  const auto lines = lines_of(sweep_table_csv(make_table(1)));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0],
            "loading.speed_m_per_s,job,state,plateau_stress_impact_mpa,plateau_stress_support_mpa,"
            "plateau_stress_to_densification_mpa,densification_strain,absorbed_energy_mj,gibson_ashby_mpa,shock_mpa,"
            "front_shock_mpa,front_strain_behind,energy_error_relative,crush_mode");
  EXPECT_EQ(lines[1].find("50,jobs/1,SUCCEEDED,1.005,0.44,,,12345,0.301,"), 0U) << lines[1];
  EXPECT_THAT(lines[1], HasSubstr(",0.0121,V"));
  EXPECT_EQ(lines[2], "100,jobs/2,FAILED,,,,,,,,,,,");
}

// Two speeds with three seeds each; one job of the second has failed.
v1::SweepTable make_averaged_table() {
  auto table = from_text<v1::SweepTable>(R"(
    fields: ["lattice.imperfection.seed", "loading.speed_m_per_s"]
    rows { job: "jobs/1" values: [1, 0.30000000000000004]
           result { state: SUCCEEDED summary { step_count: 10 plateau_window_low: 0.2 plateau_window_high: 0.4 } } }
    means { values: 0.30000000000000004 job_count: 3 succeeded_count: 3 warned_count: 1
            crush_modes { mode: CRUSH_MODE_V words: 'V-shaped band (V)' job_count: 2 } crush_modes { job_count: 1 }
            results { field: "plateau_stress_impact_mpa" job_count: 3 mean: 0.0341 deviation: 0.002 interval: 0.0049 }
            results { field: "plateau_stress_support_mpa" job_count: 3 mean: 0.025 deviation: 1e-18 interval: 2e-18 }
            results { field: "densification_strain" job_count: 1 mean: 0.658 }
            results { field: "theory.shock_mpa" job_count: 3 mean: 0.03 } })");
  *table.add_means() = table.means(0);
  auto& second = *table.mutable_means(1);
  second.set_values(0, 2.0);
  second.set_succeeded_count(2);
  second.set_failed_count(1);
  for (auto& result : *second.mutable_results()) result.set_job_count(std::min(result.job_count(), 2));
  second.mutable_results(0)->set_mean(0.0991);
  return table;
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
                          "plateau_stress_impact_mpa_interval,plateau_stress_impact_mpa_count,"),
            0U);
  EXPECT_EQ(lines[1].find("0.30000000000000004,3,3,0,0.0341,0.0049,3,0.025,"), 0U) << lines[1];
  EXPECT_TRUE(lines[2].ends_with(",V,2")) << lines[2];
}

SweepView make_view(int jobs) {
  SweepView view;
  v1::WatchSweepResponse snapshot;
  snapshot.mutable_snapshot()->set_name("sweeps/3");
  snapshot.mutable_snapshot()->add_axes()->set_field("loading.speed_m_per_s");
  for (int i = 1; i <= jobs; ++i) snapshot.mutable_snapshot()->add_jobs("jobs/" + std::to_string(i));
  view.apply(snapshot);
  for (int i = 1; i < jobs; ++i) {
    v1::WatchSweepResponse response;
    response.set_job("jobs/" + std::to_string(i));
    const v1::Job::State state = i == 1 ? v1::Job::SUCCEEDED : i == jobs - 1 ? v1::Job::RUNNING : v1::Job::PENDING;
    *response.mutable_event()->mutable_state() = make_job(i, state, 50.0 * i);
    view.apply(response);
  }
  return view;
}

TEST(SweepProgress, HasARowAJobWithValuesStateStrainAndPlateau) {
  const Terminal terminal{true, false, true};
  const auto lines = sweep_progress_lines(make_view(4), 100, 24, terminal);
  ASSERT_EQ(lines.size(), 8U);
  EXPECT_EQ(lines[0], "sweeps/3  1 of 4 jobs ended, 1 RUNNING, 2 PENDING");
  EXPECT_THAT(lines[2], HasSubstr("speed  state"));
  EXPECT_EQ(lines[4], "   50  SUCCEEDED  100.0 %     3.39    0.31  jobs/1");
  EXPECT_EQ(lines[6], "  150  RUNNING     47.3 %     3.39    0.31  jobs/3");
  EXPECT_EQ(lines[7], "       PENDING                              jobs/4");
}

TEST(SweepProgress, FitsItsTerminal) {
  const Terminal terminal{true, false, true};
  for (const int jobs : {1, 3, 40}) {
    for (const int width : {20, 40, 79, 100, 200}) {
      const auto lines = sweep_progress_lines(make_view(jobs), width, 10, terminal);
      EXPECT_LE(lines.size(), 10U);
      for (const std::string& line : lines) EXPECT_LE(display_width(line), width) << line;
    }
  }
  const auto lines = sweep_progress_lines(make_view(40), 100, 10, terminal);
  EXPECT_EQ(lines.back(), "... and 35 more jobs");
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const auto& line) {
    return line.find("RUNNING  ") != std::string::npos;
  })) << "the running job is among those that are shown";
}

TEST(SweepProgress, HasOneBarAndTheTimeLeftOfTheWholeSweep) {
  SweepView view = make_view(4);
  view.apply(from_text<v1::WatchSweepResponse>(R"(
    job: "jobs/3" event { progress { fraction: 0.5 step_count: 1000 steps_per_second: 10 seconds_left: 50 } })"));
  // 50 s of the running job, and 100 s for each of the two that wait.
  ASSERT_TRUE(view.seconds_left().has_value());
  EXPECT_NEAR(*view.seconds_left(), 250.0, 1e-9);
  EXPECT_NEAR(view.fraction(), 0.375, 1e-9);
  const auto lines = sweep_progress_lines(view, 60, 24, {});
  EXPECT_EQ(lines[1], "[############....................]  37.5 %  4 min 10 s left");
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](const auto& line) { return line.find('#') != line.npos; }), 1);
}

TEST(SweepProgress, ShowsEveryDigitOfWhatIsVaried) {
  SweepView view;
  for (const char* message :
       {R"(job: "jobs/1" event { state { name: "jobs/1" case { lattice { hexagon { wall_thickness_mm: 0.123456 }}}}})",
        R"(job: "jobs/2" event { state { name: "jobs/2" case { lattice { hexagon { wall_thickness_mm: 0.123457 }}}}})",
        R"(snapshot { axes { field: "lattice.hexagon.wall_thickness_mm" } jobs: ["jobs/1", "jobs/2"] })"})
    view.apply(from_text<v1::WatchSweepResponse>(message));
  const auto lines = sweep_progress_lines(view, 79, 24, {});
  EXPECT_THAT(lines[4], HasSubstr("0.123456"));
  EXPECT_THAT(lines[5], HasSubstr("0.123457"));
}

TEST(SweepProgress, InALogIsOneLine) {
  const std::string line = sweep_progress_line(make_view(4));
  EXPECT_EQ(line,
            "sweeps/3  36.8 %  1 of 4 jobs ended, 1 RUNNING, 2 PENDING; speed = 150 m/s: 47.3 %, plateau 3.39 MPa");
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

TEST(SweepChart, HasPointsFitAndTheoryOverSpeed) {
  const Chart chart = build_sweep_chart({{v1::Sweep(), make_table(4)}});
  EXPECT_EQ(chart.x.label, "speed (m/s)");
  EXPECT_EQ(chart.x.low, 0.0);
  EXPECT_GT(chart.x.high, 200.0);
  ASSERT_EQ(chart.curves.size(), 6U);
  EXPECT_EQ(chart.curves[0].marker, Marker::disc);
  EXPECT_EQ(chart.curves[0].x, (std::vector<double>{50, 100, 150, 200}));
  EXPECT_EQ(chart.curves[1].marker, Marker::square);
  EXPECT_EQ(chart.curves[2].name, "quadratic fit: 0.25 + 1.00·10⁻⁴ V + 3.00·10⁻⁴ V²");
  EXPECT_EQ(chart.curves[3].name, "shock theory (Eq. 51)");
  EXPECT_EQ(chart.curves[4].name, "quasi-static theory (Gibson-Ashby)");
  EXPECT_EQ(chart.curves[5].name, "shock theory, measured jumps (Eq. 52)");
  EXPECT_EQ(chart.curves[5].x, (std::vector<double>{100, 150, 200})) << "the slowest job has no front";
  EXPECT_EQ(build_sweep_chart({{v1::Sweep(), make_table(3)}}).curves[2].name.find("quadratic through the points: "),
            0U);
}

TEST(SweepChart, SaysWhatIsMissingAndRefusesToDrawNothing) {
  EXPECT_EQ(build_sweep_chart({{v1::Sweep(), make_table(2)}}).note,
            "Eq. 52: no front at 1 of 2 points; 2 of 4 jobs have no plateau");
  EXPECT_THROW(build_sweep_chart({{v1::Sweep(), make_table(0)}}), CommandError);
  EXPECT_THROW(build_sweep_chart({{v1::Sweep(), v1::SweepTable()}}), CommandError);
}

TEST(SweepChart, SeveralSweepsHaveAColourAndAMarkEachAndLogarithmicAxesOnRequest) {
  std::vector<SweepResults> sweeps(2, {v1::Sweep(), make_table(4)});
  sweeps[0].sweep.mutable_case_()->set_title("Type I");
  sweeps[1].sweep.mutable_case_()->set_title("Type II");
  const Chart chart = build_sweep_chart(sweeps, {true, true});
  ASSERT_EQ(chart.curves.size(), 4U);
  EXPECT_EQ(chart.curves[0].name, "Type I");
  EXPECT_EQ(chart.curves[2].name, "Type II");
  EXPECT_NE(chart.curves[0].marker, chart.curves[2].marker);
  EXPECT_NE(chart.curves[0].style.colour.red, chart.curves[2].style.colour.red);
  EXPECT_TRUE(chart.x.logarithmic && chart.y.logarithmic);
  EXPECT_GT(chart.y.low, 0.0);
  sweeps[1].table.set_fields(0, "depth_mm");
  EXPECT_THROW(build_sweep_chart(sweeps), CommandError);
}

TEST(SweepChart, MeansHaveBarsOfTheirIntervalsInTheUnitOfTheirSizeAndReasonsForAbsentTheories) {
  const v1::SweepTable table = charted_table(make_averaged_table(), false);
  const Chart chart = build_sweep_chart({{v1::Sweep(), table}});
  EXPECT_EQ(chart.y.label, "plateau stress (kPa)");
  const Curve& impact = chart.curves.front();
  EXPECT_NEAR(impact.y[1], 99.1, 1e-9);
  EXPECT_NEAR(impact.high[1] - impact.low[1], 9.8, 1e-9);
  EXPECT_EQ(impact.labels, (std::vector<std::string>{"!", "!"}));
  expect_parts_in(chart.note, {"95 % confidence interval", "Eq. 52: no front", "with\u00A0warnings"});
}

TEST(SweepMap, HasAPointForEveryPairOfValuesAndIsNoneOtherwise) {
  auto table = from_text<v1::SweepTable>(R"(fields: ["loading.speed_m_per_s", "depth_mm"])");
  const char* modes[] = {"CRUSH_MODE_I", "CRUSH_MODE_V", "CRUSH_MODE_V", "CRUSH_MODE_V"};
  for (int i = 0; i < 4; ++i) {
    *table.add_rows() = from_text<v1::SweepTable::Row>(fmt::format(
        "values: [{}, {}] result {{ state: {} summary {{ plateau_stress_impact_mpa: 0.0{} crush_mode: {} }} }}",
        i % 2 == 0 ? 100 : 50, i / 2 + 1, i == 3 ? "FAILED" : "SUCCEEDED", i + 1, modes[i]));
  }
  const auto map = build_sweep_map(table, {true, false});
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->across, (std::vector<double>{50.0, 100.0}));
  EXPECT_EQ(map->x.label, "speed (m/s)");
  EXPECT_EQ(std::string(map->unit.name), "kPa");
  EXPECT_NEAR(*map->stress[map->at(0, 0)], 20.0, 1e-9);
  EXPECT_NEAR(*map->stress[map->at(1, 1)], 30.0, 1e-9);
  EXPECT_FALSE(map->stress[map->at(0, 1)].has_value());
  EXPECT_EQ(map->modes[map->at(1, 0)], "mode I");
  EXPECT_THAT(map->note, HasSubstr("1 of 4 have no plateau"));
  const std::string svg = render_sweep_picture(PictureFormat::svg, {{v1::Sweep(), table}}, {}, false, {85.0, 8.0});
  expect_parts_in(svg, {"width=\"85mm\"", "font-size=\"2.82", ">20.0<", ">plateau stress, impact plate (kPa)<"});
  table.mutable_rows()->RemoveLast();
  EXPECT_FALSE(build_sweep_map(table, {}).has_value());
}

TEST(SweepChart, TwoFieldsGiveASeriesAValueOfTheSecond) {
  v1::SweepTable table = make_table(4);
  table.add_fields("lattice.hexagon.wall_thickness_mm");
  for (int i = 0; i < 4; ++i) table.mutable_rows(i)->add_values(i % 2 == 0 ? 0.3 : 0.4);
  const Chart chart = build_sweep_chart({{v1::Sweep(), table}});
  std::vector<std::string> names;
  for (const Curve& curve : chart.curves) {
    if (!curve.name.empty()) names.push_back(curve.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"wall thickness = 0.3 mm", "wall thickness = 0.4 mm"}));
  EXPECT_THAT(chart.note, HasSubstr("squares: support plate"));
}

// A search through all jobs for each event would take longer than a test may.
TEST(SweepView, EventsOfAHundredThousandJobsAreApplied) {
  constexpr int kJobs = 100'000;
  SweepView view;
  v1::WatchSweepResponse first;
  for (int i = 1; i <= kJobs; ++i) first.mutable_snapshot()->add_jobs("jobs/" + std::to_string(i));
  view.apply(first);
  for (int i = 1; i <= kJobs; ++i) {
    v1::WatchSweepResponse response;
    response.set_job("jobs/" + std::to_string(i));
    response.mutable_event()->mutable_state()->set_state(i % 2 == 0 ? v1::Job::SUCCEEDED : v1::Job::RUNNING);
    view.apply(response);
  }
  ASSERT_EQ(view.jobs().size(), static_cast<std::size_t>(kJobs));
  EXPECT_EQ(view.jobs().back().name, "jobs/100000");
  EXPECT_EQ(view.count_ended(), kJobs / 2);
}

}  // namespace
}  // namespace cellcrush::client
