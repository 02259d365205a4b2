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
      R"(quantities { field: "plateau_stress_support_mpa" decides: true limit: 0.4 interval: 0.05 order: 1.25
           meshes { elements_per_wall: 2 job_count: 3 mean: 0.327 scatter_relative: 0.008
                    error_relative: 0.182 uncertainty_relative: 0.125 }
           meshes { elements_per_wall: 4 job_count: 1 mean: 0.372 error_relative: 0.07 uncertainty_relative: 0.125 } }
         quantities { field: "absorbed_energy_mj" limit: 40700
           meshes { elements_per_wall: 2 job_count: 3 mean: 40700 } }
         elements_per_wall: 4 wanted_error_relative: 0.1 job_count_left_out: 2 mesh_words: "elements per wall"
         warnings { warning { kind: ENERGY_DRIFT message: "The residual is 2 %." remedy: "Halve the step." }
           runs { job: "jobs/3" elements_per_wall: 2 seed: 3 } runs { job: "jobs/4" elements_per_wall: 4 seed: 1 }
           runs { job: "jobs/5" elements_per_wall: 4 seed: 2 } })");
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
  EXPECT_THAT(result.output, HasSubstr("With 4 elements per wall, error and interval of both plateau"));
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

TEST(Converge, OfAFrameHasOneRunWithEachMeshAndRefusesWhatChangesNothing) {
  Script script = converge_script();
  auto& frame = *script.preset.mutable_case_()->mutable_lattice()->mutable_frame();
  frame.add_beams();
  const auto run = [&script](std::vector<std::string> more) {
    const FakeServer server(script);
    more.insert(more.begin(), {"converge", "preset:type-i"});
    const ProgramResult result = server.run(more);
    const auto creates = server.asked().sweeps.creates;
    return std::pair(creates.empty() ? 0 : creates.back().sweep().axes_size(), result.errors);
  };
  EXPECT_EQ(run({}).first, 1);
  EXPECT_THAT(run({"--seeds", "3"}).second, HasSubstr("a frame has no imperfection"));
  frame.mutable_beams(0)->set_elements(3);
  EXPECT_THAT(run({}).second, HasSubstr("leave out elements of the beams"));
}

TEST(ConvergenceText, SaysWhyNoMeshMeetsTheError) {
  v1::Convergence found = convergence();
  found.clear_elements_per_wall();
  EXPECT_THAT(convergence_text(found, 400), HasSubstr("two seeds or more with every mesh, and runs to 40 % strain."));
  found.mutable_quantities(1)->CopyFrom(found.quantities(0));
  found.mutable_quantities(1)->set_field("plateau_stress_impact_mpa");
  EXPECT_THAT(convergence_text(found, 400), HasSubstr("A finer mesh reduces both; more seeds"));
}

TEST(ConvergenceText, HasARowForEachMeshAndTheLimitBelow) {
  const std::string rows =
      "  elements per wall  runs   mean  scatter     error\n"
      "  plateau at the support plate, MPa\n"
      "                  2     3  0.327    0.8 %    18.2 %\n"
      "                  4     1  0.372              7.0 %\n"
      "   limit, order 1.2        0.400           ± 12.5 %\n"
      "  absorbed energy, J\n"
      "                  2     3   40.7              0.0 %\n"
      "              limit         40.7                ± ?\n\n";
  EXPECT_EQ(convergence_text(convergence(), 100).substr(0, rows.size()), rows);
  EXPECT_THAT(convergence_text(convergence(), 100), HasSubstr("they have not succeeded: 2 runs."));
  EXPECT_EQ(convergence_text({}, 100),
            "No estimate yet: at least one run must have succeeded with each of two meshes.\n");
}

TEST(ConvergenceText, HasEachWarningOnceWithItsRuns) {
  EXPECT_THAT(
      convergence_text(convergence(), 400),
      HasSubstr("\n  Warning (ENERGY_DRIFT) of 3 runs (2 elements per wall, seed 3; 4 elements per wall, seeds 1, "
                "2). jobs/3: The residual is 2 %.\n    Remedy: Halve the step.\n"));
}

TEST(ConvergenceText, OfAFrameNamesItsMeasuresAndBeams) {
  const auto found = from_text<v1::Convergence>(
      R"(quantities { field: "ledger.work_external_mj" decides: true limit: 2 interval: 0.02
           meshes { elements_per_wall: 2 job_count: 1 mean: 2.02 error_relative: 0.01 uncertainty_relative: 0.01 } }
         quantities { field: "ledger.plastic_mj" decides: true limit: 0.01 interval: 0.0001
           meshes { elements_per_wall: 2 job_count: 1 mean: 0.01 uncertainty_relative: 0.01 } }
         elements_per_wall: 2 wanted_error_relative: 0.05 mesh_words: "elements per beam"
         warnings { warning { kind: ENERGY_DRIFT } runs { job: "jobs/3" elements_per_wall: 2 } })");
  const std::string text = convergence_text(found, 400);
  EXPECT_EQ(text.find("  elements per beam  runs    mean    error\n  work of the loads, mJ\n"), 0U) << text;
  EXPECT_THAT(text, HasSubstr("With 2 elements per beam, error and interval of the work of the loads and the plastic "
                              "work are together within 5.0 %."));
  EXPECT_THAT(text, HasSubstr("of 1 run (2 elements per beam). jobs/3"));
  for (const char* word : {"wall", "plateau", "seed", "scatter"}) {
    EXPECT_THAT(text, ::testing::Not(HasSubstr(word)));
  }
}

}  // namespace
}  // namespace cellcrush::client::testing
