#include "help/case_manual.h"

#include <gtest/gtest.h>

#include "command_error.h"
#include "help/field_rules.h"
#include "help/wrapped_text.h"

namespace cellcrush::client {
namespace {

TEST(CaseManual, AFieldHasTypeUnitDefaultAndLimits) {
  const FieldManual ramp = find_field_manual("loading.ramp_strain");
  EXPECT_EQ(ramp.type, "double");
  EXPECT_EQ(ramp.unit, "");
  EXPECT_EQ(ramp.default_value, "0 (full speed at once)");
  EXPECT_EQ(ramp.limits, "0 to below end_strain");
  EXPECT_EQ(ramp.comment, "Nominal strain over which the speed rises linearly in time from 0 to V.");
  const FieldManual speed = find_field_manual("loading.speed_m_per_s");
  EXPECT_EQ(speed.unit, "m/s");
  EXPECT_EQ(speed.default_value, "required");
  EXPECT_EQ(speed.limits, "1e-6 to 1000");
}

TEST(CaseManual, AnEnumHasItsValuesAndAGroupItsFields) {
  const FieldManual plane = find_field_manual("material.plane");
  ASSERT_EQ(plane.values.size(), 2U);
  EXPECT_EQ(plane.values[0].first, "PLANE_STRESS");
  EXPECT_EQ(plane.values[0].second, "Walls are free to contract along the depth.");
  EXPECT_EQ(plane.default_value, "PLANE_STRESS");
  const FieldManual loading = find_field_manual("loading");
  ASSERT_EQ(loading.fields.size(), 4U);
  EXPECT_EQ(loading.fields[1].first, "speed_m_per_s");
  EXPECT_EQ(loading.fields[1].second, "Speed V of the impact plate.");
  EXPECT_EQ(find_field_manual("").fields.size(), 11U);
}

TEST(CaseManual, AnElementOfAListNeedsNoIndex) {
  EXPECT_EQ(find_field_manual("lattice.frame.nodes[0].x_mm").comment,
            find_field_manual("lattice.frame.nodes.x_mm").comment);
}

TEST(CaseManual, AnUnknownPathIsRefusedWithTheNearest) {
  const std::pair<const char*, const char*> paths[] = {
      {"loading.ramp_strian", "did you mean \"ramp_strain\"?"},
      {"ramp_strain", "did you mean \"loading.ramp_strain\"?"},
      {"depth_mm.x", "is a single value"},
  };
  for (const auto& [path, answer] : paths) {
    try {
      find_field_manual(path);
      ADD_FAILURE() << path;
    } catch (const CommandError& error) {
      EXPECT_EQ(error.code(), ExitCode::refused);
      EXPECT_NE(error.message().find(answer), std::string::npos) << error.message();
    }
  }
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
}

TEST(FieldRules, LimitsAreNumbersAndWords) {
  for (const auto& [path, limits] : std::vector<std::pair<std::string, std::string>>{
           {"numerics.time_step_s", "0 to 1, at most the stable step of the undeformed mesh"},
           {"lattice.frame.gravity_x_m_per_s2", "-1e9 to 1e9"},
           {"loading.end_strain", "0.0001 to below 0.95"},
           {"lattice.frame.loads", "at most 200000"},
           {"lattice.square.wall_thickness_mm", "1e-6 to half of side_mm"},
           {"title", "at most 200 characters"}}) {
    EXPECT_EQ(find_field_manual(path).limits, limits) << path;
  }
}

TEST(FieldRules, TheUnitIsTheEndOfTheName) {
  for (const auto& [name, unit] : std::vector<std::pair<std::string, std::string>>{{"speed_m_per_s", "m/s"},
                                                                                   {"mass_damping_per_s", "1/s"},
                                                                                   {"density_kg_per_m3", "kg/m3"},
                                                                                   {"force_n_or_n_mm", "N or N mm"},
                                                                                   {"side_mm", "mm"},
                                                                                   {"end_strain", ""},
                                                                                   {"columns", ""}}) {
    EXPECT_EQ(unit_of(name), unit) << name;
  }
}

TEST(WrappedText, BreaksAtSpacesAndKeepsParagraphs) {
  EXPECT_EQ(wrap_text("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrap_text("one\n\ntwo three", 20), "one\n\ntwo three");
  EXPECT_EQ(wrap_text("lattices are", 5), "latti\nces\nare") << "a word longer than a line";
}

}  // namespace
}  // namespace cellcrush::client
