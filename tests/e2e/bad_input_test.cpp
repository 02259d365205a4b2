// What is wrong with a case is said with field paths and remedies, all at once, and costs the daemon nothing.
#include <gmock/gmock.h>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using ::testing::HasSubstr;

class BadInput : public DaemonTest {
 protected:
  // Expects that `check` and `submit` both refuse, name every text of `expected`, and that the daemon still answers.
  void expect_refused(const std::vector<std::string>& source, const std::vector<std::string>& expected) const {
    for (const char* verb : {"check", "submit"}) {
      std::vector<std::string> arguments{verb};
      arguments.insert(arguments.end(), source.begin(), source.end());
      const Outcome outcome = cellcrush(arguments);
      EXPECT_EQ(outcome.exit_code, 2) << verb << ":\n" << outcome.all();
      for (const std::string& text : expected) EXPECT_THAT(outcome.all(), HasSubstr(text)) << verb;
    }
    const Outcome listed = cellcrush({"list", "--json"});
    EXPECT_EQ(listed.exit_code, 0) << "The daemon does not go on:\n" << listed.all();
    EXPECT_THAT(listed.output, ::testing::Not(HasSubstr("jobs/"))) << "A refused case was queued.";
  }
};

TEST_F(BadInput, IsRefusedWithFieldsAndRemedies) {
  const std::string small = write_file("small.txtpb", small_case());
  const std::string cut = small_case().substr(0, small_case().find("wall_thickness_mm"));
  const std::pair<std::vector<std::string>, std::vector<std::string>> cases[] = {
      {{write_file("empty.txtpb", "")},
       {"lattice", "depth_mm", "material.youngs_modulus_mpa", "material.yield_stress_mpa", "material.density_kg_per_m3",
        "loading.speed_m_per_s", "Remedy"}},
      {{small, "--set", "lattice.hexagon.wall_thickness_mm=-0.3"},
       {"lattice.hexagon.wall_thickness_mm", "-0.3", "Remedy"}},
      {{small, "--set", "material.yield_stress_mpa=nan"}, {"material.yield_stress_mpa", "nan", "write digits"}},
      {{write_file("nan.txtpb", small_case() + "numerics { mass_damping_per_s: nan }\n")},
       {"numerics.mass_damping_per_s", "nan", "Remedy"}},
      {{small, "--set", "loading.speed_m_per_s=0"}, {"loading.speed_m_per_s", "0", "Remedy"}},
      {{small, "--set", "numerics.time_step_s=1e-6"}, {"numerics.time_step_s", "stable", "Remedy"}},
      {{"preset:type-iv"}, {"type-iv", "hexagon-small"}},
      {{write_file("misspelt.txtpb", small_case() + "dept_mm: 4\n")}, {"misspelt.txtpb:7:", "dept_mm", "depth_mm"}},
      {{write_file("misspelt.json", R"({"material": {"youngs_modulus": 69000}})")},
       {"misspelt.json", "material", "youngs_modulus"}},
      {{small, "--set", "loading.speed=5"}, {"loading.speed", "speed_m_per_s"}},
      {{write_file("cut.txtpb", cut)}, {"cut.txtpb:"}},
      {{write_file("cut.json", R"({"lattice": {"hexagon": {"columns": 4,)")}, {"cut.json"}},
      {{(folder() / "absent.txtpb").string()}, {"absent.txtpb"}},
      {{small, "--set", "lattice.hexagon.wall_thickness_mm=-1", "--set", "depth_mm=0", "--set",
        "material.density_kg_per_m3=-1", "--set", "loading.speed_m_per_s=-5", "--set", "loading.end_strain=2", "--set",
        "section.depth_points=1"},
       {"lattice.hexagon.wall_thickness_mm", "depth_mm", "material.density_kg_per_m3", "loading.speed_m_per_s",
        "loading.end_strain", "section.depth_points"}}};
  for (const auto& [source, expected] : cases) expect_refused(source, expected);
}

}  // namespace
}  // namespace cellcrush::e2e
