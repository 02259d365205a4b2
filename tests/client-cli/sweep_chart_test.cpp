#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "command_error.h"
#include "expect_text.h"
#include "plots/job_picture.h"
#include "plots/sweep_curves.h"
#include "plots/sweep_map.h"
#include "programs/text_proto.h"
#include "sweep_samples.h"
#include "terminal/sweep_chart_text.h"

namespace cellcrush::client {
namespace {

using cellcrush::testing::from_text;
using testing::expect_parts_in;
using ::testing::HasSubstr;
using testing::lines_of;
using testing::make_averaged_table;
using testing::make_table;

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

TEST(SweepMap, IsNeverOverSeedsWhichAreCurvesOverTheOtherField) {
  const std::vector<std::vector<double>> rows = {{1, 50}, {1, 100}, {2, 50}, {2, 100}};
  const auto table = make_table("fields: ['lattice.imperfection.seed', 'loading.speed_m_per_s']", rows);
  const std::string svg = render_sweep_picture(PictureFormat::svg, {{v1::Sweep(), charted_table(table, true)}}, {});
  expect_parts_in(svg, {">seed = 1<", ">seed = 2<", ">speed (m/s)<", ">plateau stress (MPa)<"});
  EXPECT_FALSE(build_sweep_map(table, {}).has_value());
}

TEST(SweepMap, ItsAxesAreNotNegativeWhereTheValuesAreNot) {
  const auto table = make_table("fields: ['loading.speed_m_per_s', 'depth_mm']", {{10, 0}, {10, 4}, {90, 0}, {90, 4}});
  const auto map = build_sweep_map(table, {});
  ASSERT_TRUE(map.has_value());
  EXPECT_EQ(map->x.low, 0.0);
  EXPECT_EQ(map->y.low, 0.0);
  for (const double value : {0.0, 0.05, 0.3, 200.0}) {
    const Axis axis = build_sweep_chart({{v1::Sweep(), make_table("fields: 'depth_mm'", {{value}})}}).x;
    EXPECT_GE(axis.low, 0.0) << value;
    EXPECT_GT(axis.high, value);
  }
}

TEST(SweepChart, NamesOfSeveralSweepsSayWhatTellsThemApart) {
  const auto table = make_table("fields: 'loading.speed_m_per_s'", {{50}, {100}});
  const auto thick = make_table("fields: ['loading.speed_m_per_s', 'depth_mm']", {{50, 4}, {50, 8}});
  const auto names = [](const std::vector<SweepResults>& sweeps) {
    std::vector<std::string> out;
    for (const Curve& curve : build_sweep_chart(sweeps).curves) out.push_back(curve.name);
    return out;
  };
  const auto sweep = [](const char* text) { return from_text<v1::Sweep>(text); };
  const auto plain = sweep("name: 'sweeps/1' case { title: 'A' depth_mm: 2 loading { speed_m_per_s: 9 } }");
  const auto hard = sweep("name: 'sweeps/2' case { title: 'A' depth_mm: 2 material { hardening_modulus_mpa: 69 } }");
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({{plain, table}, {hard, table}}), (Names{"hardening modulus = 0 MPa", "hardening modulus = 69 MPa"}))
      << "a default is a value, and the field that both vary is none";
  EXPECT_EQ(names({{plain, table}, {plain, thick}}), (Names{"depth = 2 mm", "depth = 4 mm", "depth = 8 mm"}));
  const auto other = sweep("name: 'sweeps/3' case { title: 'B' depth_mm: 3 }");
  EXPECT_EQ(names({{plain, table}, {hard, table}, {other, table}}),
            (Names{"A, hardening modulus = 0 MPa", "A, hardening modulus = 69 MPa", "B"}));
  auto again = plain;
  again.set_name("sweeps/4");
  EXPECT_EQ(names({{plain, table}, {again, table}}), (Names{"sweeps/1", "sweeps/4"}));
}

// The frame ends 12 units before the picture does; a letter stays 8 away from it.
TEST(SweepChart, NoLetterOfAPointReachesTheFrame) {
  const v1::SweepTable table = charted_table(make_averaged_table(), false);
  const std::string svg =
      render_sweep_picture(PictureFormat::svg, {{v1::Sweep(), table}}, {}, true, {.width_mm = 85.0});
  const std::regex letter("<text x=\"([0-9.]+)\"[^>]*>!<");
  double last = 0.0;
  for (std::sregex_iterator found(svg.begin(), svg.end(), letter), end; found != end; ++found)
    last = std::max(last, std::stod((*found)[1]));
  EXPECT_GT(last, 40.0);
  EXPECT_LT(last, 85.0 - 20.0 / 96.0 * 25.4);
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

}  // namespace
}  // namespace cellcrush::client
