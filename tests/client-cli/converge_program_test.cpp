#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_server.h"
#include "program.h"
#include "terminal/sweep_text.h"

namespace cellcrush::client::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

v1::Convergence convergence() {
  return from_text<v1::Convergence>(
      R"(quantities { field: "plateau_stress_support_mpa"
           meshes { elements_per_wall: 2 job_count: 3 mean: 0.327 scatter_relative: 0.008
                    error_relative: 0.122 uncertainty_relative: 0.012 }
           meshes { elements_per_wall: 4 job_count: 1 mean: 0.372 error_relative: 0.122 } }
         quantities { field: "absorbed_energy_mj" meshes { elements_per_wall: 2 job_count: 3 mean: 40700 } }
         elements_per_wall: 4 wanted_error_relative: 0.1 job_count_left_out: 2)");
}

Script converge_script() {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.preset.set_name("type-i");
  *script.preset.mutable_case_() = make_job(v1::Job::RUNNING).case_();
  script.sweeps = make_sweep_script({v1::Job::SUCCEEDED, v1::Job::SUCCEEDED});
  script.sweeps.sweep.set_predicted_seconds(12.0);
  script.sweeps.convergence = convergence();
  script.check.mutable_completed_case()->set_elements_per_wall(8);
  return script;
}

const std::vector<std::string> kCase = {"converge", "preset:type-i", "--set", "lattice.imperfection.amplitude_mm=0.01"};

TEST(Converge, TellsItsCostQueuesMeshesWithSeedsAndPrintsTheEstimates) {
  const FakeServer server(converge_script());
  auto arguments = kCase;
  arguments.insert(arguments.end(), {"--meshes", "2,4", "--seeds", "3", "--error", "0.1", "--executor", "slurm/a"});
  const ProgramResult result = server.run(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("6 runs, predicted to take 12 s of one core"));
  EXPECT_EQ(result.output.find("sweeps/test\n"), 0U);
  EXPECT_THAT(result.output, HasSubstr("With 4 elements per wall, error and interval"));
  const auto creates = server.asked().sweeps.creates;
  ASSERT_EQ(creates.size(), 2U);
  EXPECT_TRUE(creates[0].validate_only());
  EXPECT_FALSE(creates[1].validate_only());
  const v1::Sweep& sweep = creates[1].sweep();
  EXPECT_EQ(sweep.executor(), "slurm/a");
  ASSERT_EQ(sweep.axes_size(), 2);
  EXPECT_EQ(sweep.axes(0).field(), "elements_per_wall");
  EXPECT_EQ(sweep.axes(0).list().values(1), 4.0);
  EXPECT_EQ(sweep.axes(1).seed_count(), 3);
}

TEST(Converge, ForItsCostAloneNothingIsQueued) {
  const FakeServer server(converge_script());
  auto arguments = kCase;
  arguments.emplace_back("--cost");
  EXPECT_EQ(server.run(arguments).output, "15 runs, predicted to take 12 s of one core\n");
  const auto creates = server.asked().sweeps.creates;
  ASSERT_EQ(creates.size(), 1U);
  EXPECT_TRUE(creates[0].validate_only());
}

TEST(Converge, ComparesMeshesAboutThatOfTheCase) {
  Script script = converge_script();
  const auto meshes_about = [&script](int elements) {
    script.check.mutable_completed_case()->set_elements_per_wall(elements);
    const FakeServer server(script);
    EXPECT_EQ(server.run(kCase).exit_code, 0);
    EXPECT_EQ(server.asked().checked.lattice().imperfection().amplitude_mm(), 0.01);
    const auto values = server.asked().sweeps.creates.back().sweep().axes(0).list().values();
    return std::vector<double>(values.begin(), values.end());
  };
  EXPECT_THAT(meshes_about(8), ElementsAre(4.0, 8.0, 16.0));
  EXPECT_THAT(meshes_about(2), ElementsAre(2.0, 4.0, 8.0));
  EXPECT_THAT(meshes_about(3), ElementsAre(3.0, 6.0, 12.0));
  EXPECT_THAT(meshes_about(64), ElementsAre(16.0, 32.0, 64.0));
}

TEST(Converge, ACaseWithProblemsIsRefusedWithThem) {
  Script script = converge_script();
  auto& problem = *script.check.add_problems();
  problem.set_field("depth_mm");
  problem.set_message("is missing");
  const FakeServer server(std::move(script));
  const ProgramResult refused = server.run(kCase);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("depth_mm"));
  EXPECT_TRUE(server.asked().sweeps.creates.empty());
}

TEST(Converge, WithoutAnImperfectionSeedsAreRefusedWithARemedy) {
  Script script = converge_script();
  script.preset.mutable_case_()->mutable_lattice()->clear_imperfection();
  const FakeServer server(std::move(script));
  const ProgramResult refused = server.run({"converge", "preset:type-i"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("--set lattice.imperfection.amplitude_mm=0.01"));
  EXPECT_EQ(server.run({"converge", "preset:type-i", "--seeds", "1"}).exit_code, 0);
  EXPECT_EQ(server.asked().sweeps.creates.back().sweep().axes_size(), 1);
}

TEST(Converge, OfASweepPrintsItsEstimatesAgain) {
  const FakeServer server(converge_script());
  EXPECT_EQ(server.run({"converge", "sweeps/test", "--error", "0.1"}).output, convergence_text(convergence(), 80));
  const auto found = from_json<v1::Convergence>(server.run({"converge", "sweeps/test", "--json"}).output);
  EXPECT_EQ(found.quantities_size(), 2);
  EXPECT_EQ(server.run({"converge", "sweeps/none"}).exit_code, 5);
  EXPECT_TRUE(server.asked().sweeps.creates.empty());
}

TEST(ConvergenceText, SaysWhyNoMeshMeetsTheError) {
  v1::Convergence found = convergence();
  found.clear_elements_per_wall();
  EXPECT_THAT(convergence_text(found, 200), HasSubstr("cannot be told: this takes two seeds"));
  v1::Convergence::Quantity& support = *found.mutable_quantities(0);
  support.mutable_meshes(1)->set_uncertainty_relative(0.01);
  *found.mutable_quantities(1) = support;
  found.mutable_quantities(1)->set_field("plateau_stress_impact_mpa");
  EXPECT_THAT(convergence_text(found, 200), HasSubstr("add a finer mesh"));
}

TEST(ConvergenceText, HasARowAMeshAndNoIntervalOfASingleRun) {
  const std::string rows =
      "  elements per wall  runs   mean  scatter           error\n"
      "  plateau at the support plate, MPa\n"
      "                  2     3  0.327    0.8 %  12.2 % ± 1.2 %\n"
      "                  4     1  0.372               12.2 % ± ?\n"
      "  absorbed energy, J\n"
      "                  2     3   40.7                0.0 % ± ?\n\n";
  EXPECT_EQ(convergence_text(convergence(), 100).substr(0, rows.size()), rows);
  EXPECT_THAT(convergence_text(convergence(), 100), HasSubstr("they have not succeeded: 2 runs."));
  EXPECT_EQ(convergence_text({}, 100),
            "No estimate yet: at least one run must have succeeded with each of two meshes.\n");
}

}  // namespace
}  // namespace cellcrush::client::testing
