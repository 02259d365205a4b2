// `cellcrush explain` and what it is made from.
#include <gmock/gmock.h>
#include <google/protobuf/struct.pb.h>

#include "case_file/field_names.h"
#include "columns/field_text.h"
#include "help/case_manual.h"
#include "help/field_rules.h"
#include "program.h"

namespace cellcrush::client {

namespace {

using testing::expect_parts_in;
using ::testing::HasSubstr;
using testing::ProgramResult;
using testing::run_program;

TEST(Explain, PrintsAFieldWithoutADaemon) {
  const ProgramResult result = run_program({"explain", "loading.ramp_strain", "--server", "unix:/nowhere"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.output,
            "loading.ramp_strain\n"
            "  Type     double\n"
            "  Unit     none (dimensionless)\n"
            "  Default  0 (full speed at once)\n"
            "  Limits   0 to below end_strain\n"
            "\n"
            "Nominal strain over which the speed rises linearly in time from 0 to V.\n");
  expect_parts_in(run_program({"explain", "loading.speed_m_per_s"}).output,
                  {"  Unit     m/s\n", "  Default  required\n", "  Limits   1e-6 to 1000"});
  expect_parts_in(
      run_program({"explain", "material.plane"}).output,
      {"  Default  PLANE_STRESS\n", "Values:\n  PLANE_STRESS  Walls are free to contract along the depth: bars"});
  EXPECT_THAT(run_program({"explain", "loading"}).output,
              HasSubstr("\n  speed_m_per_s       Speed V of the impact plate.\n"));
  EXPECT_THAT(run_program({"explain"}).output,
              HasSubstr("\n  loading            What presses on the lattice, and when the run ends.\n"));
}

TEST(Explain, AnUnknownPathIsRefusedWithTheNearest) {
  for (const auto& [path, answer] :
       {std::pair("loading.ramp_strian", "did you mean \"ramp_strain\"?"),
        std::pair("ramp_strain", "did you mean \"loading.ramp_strain\"?"),
        std::pair("speed_m_per_s", "did you mean \"loading.speed_m_per_s\"?"),
        std::pair("friction", "did you mean \"contact.friction\"?"), std::pair("depth_mm.x", "is a single value")}) {
    const ProgramResult result = run_program({"explain", path});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.errors, HasSubstr(answer));
  }
}

TEST(Explain, WithJsonItIsAnObject) {
  const auto object = cellcrush::testing::from_json<google::protobuf::Struct>(
      run_program({"explain", "loading.direction", "--json"}).output);
  EXPECT_EQ(object.fields().at("default").string_value(), "X");
  EXPECT_EQ(object.fields().at("values").list_value().values_size(), 2);
}

TEST(CaseManual, EveryFieldSaysWhatItIsAndEachValueItsDefaultAndLimits) {
  const std::vector<std::string> paths = case_paths();
  EXPECT_GT(paths.size(), 100U);
  for (const std::string& path : paths) {
    const FieldManual manual = find_field_manual(path);
    EXPECT_NE(manual.comment, "") << path;
    if (!manual.fields.empty()) continue;
    EXPECT_NE(manual.default_value, "") << path;
    const bool number = manual.type.find("double") != std::string::npos || manual.type.find("int") != std::string::npos;
    EXPECT_TRUE(!number || !manual.limits.empty()) << path << ": " << manual.comment;
    for (const auto& [value, comment] : manual.values) EXPECT_NE(comment, "") << path << " " << value;
  }
  EXPECT_EQ(find_field_manual("lattice.frame.nodes[0].x_mm").comment,
            find_field_manual("lattice.frame.nodes.x_mm").comment);
}

TEST(CaseManual, LimitsAreNumbersAndWords) {
  for (const auto& [path, limits] :
       {std::pair("numerics.time_step_s", "0 to 1, at most the stable step of the undeformed mesh"),
        std::pair("lattice.frame.gravity_x_m_per_s2", "-1e9 to 1e9"),
        std::pair("loading.end_strain", "0.0001 to below 0.95"), std::pair("lattice.frame.loads", "at most 200000"),
        std::pair("lattice.square.wall_thickness_mm", "1e-6 to half of side_mm"),
        std::pair("title", "at most 200 characters")}) {
    EXPECT_EQ(find_field_manual(path).limits, limits) << path;
  }
}

TEST(CaseManual, TheUnitIsTheEndOfTheName) {
  for (const auto& [name, unit] :
       {std::pair("speed_m_per_s", "m/s"), std::pair("mass_damping_per_s", "1/s"), std::pair("side_mm", "mm"),
        std::pair("density_kg_per_m3", "kg/m3"), std::pair("force_n_or_n_mm", "N or N mm"), std::pair("end_strain", ""),
        std::pair("columns", "")}) {
    EXPECT_EQ(unit_of(name), unit) << name;
  }
}

}  // namespace

}  // namespace cellcrush::client
