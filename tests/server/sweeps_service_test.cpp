// Sweeps: their points, their jobs and what their tables tell.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "error.h"
#include "google/rpc/status.pb.h"
#include "jobs/convergence.h"
#include "jobs/seed_means.h"
#include "programs/text_proto.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SweepsServiceTest : public DaemonFixture {
 protected:
  std::size_t job_count() { return client().list().size(); }

  static v1::ProblemList problems_of(const grpc::Status& status) {
    google::rpc::Status details;
    EXPECT_TRUE(details.ParseFromString(status.error_details()));
    v1::ProblemList list;
    EXPECT_TRUE(details.details_size() > 1 && details.details(1).UnpackTo(&list));
    return list;
  }
};

TEST_F(SweepsServiceTest, ThreeSpeedsGiveATableOfThreeResults) {
  auto client = this->client();
  auto request = sweep_of(small_case(), kSpeed, {50.0, 100.0, 200.0});
  (*request.mutable_sweep()->mutable_labels())["batch"] = "speeds";
  const auto sweep = create(client, request);
  EXPECT_EQ(sweep.name(), "sweeps/1");
  EXPECT_THAT(sweep.jobs(), ElementsAre("jobs/1", "jobs/2", "jobs/3"));
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, 3));
  const auto table = table_of(client, sweep.name());
  EXPECT_THAT(table.fields(), ElementsAre(kSpeed));
  ASSERT_EQ(table.rows_size(), 3);
  double plateau = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto& row = table.rows(i);
    EXPECT_EQ(row.job(), sweep.jobs(i));
    EXPECT_THAT(row.values(), ElementsAre(50.0 * (1 << i)));
    EXPECT_EQ(row.result().state(), v1::Job::SUCCEEDED);
    EXPECT_GT(row.result().summary().plateau_stress_impact_mpa(), plateau) << "Faster is stiffer.";
    EXPECT_GT(row.result().summary().theory().shock_mpa(), 0.0);
    plateau = row.result().summary().plateau_stress_impact_mpa();
    const auto job = client.get(row.job());
    EXPECT_EQ(job.case_().loading().speed_m_per_s(), row.values(0));
    EXPECT_EQ(job.labels().at("batch"), "speeds");
  }
  EXPECT_EQ(client.get("jobs/1").case_().title(), "A few cells, loading.speed_m_per_s = 50");
}

TEST_F(SweepsServiceTest, ABadPointLeavesNoJobAndIsNamed) {
  auto request = sweep_of(small_case(), kSpeed, {50.0, -100.0, 200.0});
  auto& rows = *request.mutable_sweep()->add_axes();
  rows.set_field("lattice.hexagon.rows");
  for (const double value : {5.0, 2.5, 0.0}) rows.mutable_list()->add_values(value);
  const auto status = client().try_to(request);
  EXPECT_THAT(status, Fails(grpc::StatusCode::INVALID_ARGUMENT, "The sweep has 3 problems"));
  const auto list = problems_of(status);
  ASSERT_EQ(list.problems_size(), 3);
  EXPECT_EQ(list.problems(0).field(), "lattice.hexagon.rows");
  EXPECT_THAT(list.problems(0).message(), HasSubstr("is 2.5, which is not a whole number"));
  EXPECT_THAT(list.problems(0).message(),
              HasSubstr("to point 2 of 9 (loading.speed_m_per_s = 50, lattice.hexagon.rows = 2.5) and to 2 more"));
  EXPECT_EQ(list.problems(1).field(), "lattice.hexagon.rows");
  EXPECT_EQ(list.problems(2).field(), "loading.speed_m_per_s");
  EXPECT_THAT(list.problems(2).message(), HasSubstr("to point 4 of 9"));
  EXPECT_EQ(job_count(), 0U);
  EXPECT_EQ(answer_of(*client().sweeps, &v1::Sweeps::Stub::ListSweeps, {}).sweeps_size(), 0);
}

TEST_F(SweepsServiceTest, SeedsOfACaseWithoutImperfectionsAreNoted) {
  auto submitted = small_case();
  submitted.mutable_lattice()->clear_imperfection();
  auto client = this->client();
  const auto sweep = create(client, sweep_of(submitted, "lattice.imperfection.seed", {1.0, 2.0}));
  ASSERT_EQ(sweep.notes_size(), 1);
  EXPECT_THAT(sweep.notes(0).message(), HasSubstr("has no effect"));
  submitted.mutable_lattice()->mutable_imperfection()->set_bow_mm(0.01);
  EXPECT_EQ(create(client, sweep_of(submitted, "lattice.imperfection.seed", {1.0, 2.0})).notes_size(), 0);
}

TEST_F(SweepsServiceTest, ImplausibleValuesOfTheCaseAreNotedOnce) {
  auto submitted = small_case();
  submitted.mutable_material()->set_density_kg_per_m3(2.7);
  auto client = this->client();
  const auto sweep = create(client, sweep_of(submitted, kSpeed, {50.0, 100.0, 200.0}));
  ASSERT_EQ(sweep.notes_size(), 1);
  EXPECT_EQ(sweep.notes(0).field(), "material.density_kg_per_m3");
  EXPECT_EQ(sweep.notes(0).kind(), v1::Problem::IMPLAUSIBLE);
  EXPECT_THAT(sweep.notes(0).message(), Not(HasSubstr("applies to point"))) << "It is the same for all.";
  EXPECT_EQ(get_sweep(client, sweep.name()).notes_size(), 0) << "They belong to the answer alone.";
}

TEST_F(SweepsServiceTest, ImplausibleValuesOfSomePointsAreNotedWithTheFirst) {
  auto request = sweep_of(small_case(), "material.density_kg_per_m3", {2700.0, 2.7, 7.8, 0.9});
  request.set_validate_only(true);
  auto client = this->client();
  const auto sweep = create(client, request);
  ASSERT_EQ(sweep.notes_size(), 1) << sweep.DebugString();
  EXPECT_EQ(sweep.notes(0).value(), "2.7");
  EXPECT_THAT(sweep.notes(0).message(),
              HasSubstr("This applies to point 2 of 4 (material.density_kg_per_m3 = 2.7) and to 2 more."));
  EXPECT_THAT(sweep.notes(0).remedy(), HasSubstr("2700 kg/m^3"));
  EXPECT_EQ(job_count(), 0U);
}

TEST_F(SweepsServiceTest, ListedPointsThatRepeatAreNotedWithTheFirst) {
  const auto notes_of = [this](const std::vector<double>& speeds, bool validate_only) {
    v1::CreateSweepRequest request;
    request.set_validate_only(validate_only);
    *request.mutable_sweep()->mutable_case_() = tiny_case();
    for (const double speed : speeds) (*request.mutable_sweep()->add_points()->mutable_fields())[kSpeed] = speed;
    auto client = this->client();
    return create(client, request).notes();
  };
  for (const bool validate_only : {true, false}) {
    const auto notes = notes_of({50.0, 80.0, 70.0, 80.0, 50.0, 80.0}, validate_only);
    ASSERT_EQ(notes.size(), 1);
    EXPECT_EQ(notes[0].field(), "sweep.points");
    EXPECT_EQ(notes[0].kind(), v1::Problem::IMPLAUSIBLE);
    EXPECT_EQ(notes[0].message(),
              "have 3 entries that repeat an earlier one: first point 4 of 6 (loading.speed_m_per_s = 80) equals point "
              "2.");
  }
  EXPECT_THAT(notes_of({50.0, 50.0}, true)[0].message(),
              HasSubstr("have 1 entry that repeats an earlier one: point 2"));
  EXPECT_EQ(notes_of({50.0, 80.0}, true).size(), 0);
}

TEST_F(SweepsServiceTest, WhatIsNoSweepIsRefusedByField) {
  const auto expect = [this](const v1::CreateSweepRequest& request, const std::string& text) {
    const auto status = client().try_to(request);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << text;
    EXPECT_THAT(status.error_message(), HasSubstr(text));
  };
  v1::CreateSweepRequest request;
  expect(request, "sweep.axes are missing");
  expect(sweep_of(small_case(), "loading.velocity", {1.0}), "loading.velocity is not a field of a case");
  expect(sweep_of(small_case(), "title", {1.0}), "title is not a single number");
  expect(sweep_of(small_case(), "lattice.square.rows", {1.0}), "lattice.square.rows is not in the case");
  request = sweep_of(small_case(), kSpeed, {1.0});
  request.mutable_sweep()->set_max_parallel(-1);
  expect(request, "sweep.max_parallel is negative");
  request = sweep_of(small_case(), kSpeed, {1.0});
  request.set_request_id(std::string(129, 'x'));
  expect(request, "request_id");
  request = sweep_of(small_case(), kSpeed, {1.0});
  (*request.mutable_sweep()->mutable_labels())[""] = "x";
  expect(request, "sweep.labels");
  request = sweep_of(small_case(), kSpeed, {1.0});
  request.mutable_sweep()->set_max_failures(-1);
  expect(request, "sweep.max_failures is negative");
}

TEST_F(SweepsServiceTest, ValidateOnlyQueuesNothing) {
  auto client = this->client();
  auto request = sweep_of(small_case(), kSpeed, {50.0, 100.0});
  request.set_validate_only(true);
  EXPECT_TRUE(create(client, request).name().empty());
  EXPECT_EQ(job_count(), 0U);
}

TEST_F(SweepsServiceTest, ARequestIdMakesOneSweep) {
  auto client = this->client();
  auto request = sweep_of(small_case(), kSpeed, {50.0, 100.0});
  request.set_request_id("the same");
  const auto first = create(client, request);
  EXPECT_EQ(create(client, request).name(), first.name());
  EXPECT_EQ(job_count(), 2U);
  request.mutable_sweep()->mutable_axes(0)->mutable_list()->add_values(150.0);
  EXPECT_EQ(client.try_to(request).error_code(), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_EQ(job_count(), 2U);
}

TEST_F(SweepsServiceTest, CancellingStopsRunningJobsAndKeepsWhatHasEnded) {
  auto client = this->client();
  const auto sweep = create(client, sweep_of(endless_case(), kSpeed, {1.0, 1.5, 2.0}));
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::RUNNING, 2));
  const auto out = cancel_sweep(client, sweep.name());
  EXPECT_EQ(count_in(out, v1::Job::RUNNING) + count_in(out, v1::Job::PENDING), 0);
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::CANCELLED, 3));
  EXPECT_EQ(count_in(cancel_sweep(client, sweep.name()), v1::Job::CANCELLED), 3) << "Again changes nothing.";
}

TEST_F(SweepsServiceTest, ASweepKeepsToItsShareOfTheWorkers) {
  auto client = this->client();
  auto request = sweep_of(endless_case(), kSpeed, {1.0, 1.5, 2.0});
  request.mutable_sweep()->set_max_parallel(1);
  const auto sweep = create(client, request);
  const std::string other = client.create(small_case(), v1::Job::SUCCEEDED);
  const auto now = get_sweep(client, sweep.name());
  EXPECT_EQ(count_in(now, v1::Job::RUNNING), 1);
  EXPECT_EQ(count_in(now, v1::Job::PENDING), 2);
  ASSERT_TRUE(client.cancel(now.jobs(0)).ok());
  EXPECT_TRUE(client.wait_for_state(now.jobs(1), v1::Job::RUNNING));
  EXPECT_EQ(client.get(now.jobs(2)).state(), v1::Job::PENDING);
}

TEST_F(SweepsServiceTest, SweepsAreListedInPagesAndUnknownOnesAreNotFound) {
  auto client = this->client();
  for (int i = 0; i < 3; ++i) create(client, sweep_of(small_case(), kSpeed, {300.0}));
  v1::ListSweepsRequest request;
  request.set_page_size(2);
  const auto response = answer_of(*client.sweeps, &v1::Sweeps::Stub::ListSweeps, request);
  ASSERT_EQ(response.sweeps_size(), 2);
  EXPECT_EQ(response.sweeps(0).name(), "sweeps/3");
  EXPECT_EQ(response.sweeps(0).jobs(0), "jobs/3");
  create(client, sweep_of(small_case(), kSpeed, {300.0}));
  request.set_page_token(response.next_page_token());
  const auto rest = answer_of(*client.sweeps, &v1::Sweeps::Stub::ListSweeps, request);
  ASSERT_EQ(rest.sweeps_size(), 1);
  EXPECT_EQ(rest.sweeps(0).name(), "sweeps/1");
  EXPECT_TRUE(rest.next_page_token().empty());
  EXPECT_EQ(try_call(*client.sweeps, &v1::Sweeps::Stub::GetSweep, named<v1::GetSweepRequest>("sweeps/9")).error_code(),
            grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(watch_sweep(client, "jobs/1").status.error_code(), grpc::StatusCode::NOT_FOUND);
}

constexpr const char* kMesh = "elements_per_wall";

v1::CreateSweepRequest sweep_over_meshes(const std::vector<double>& meshes, int seeds) {
  return with_text(sweep_of(small_case(), kMesh, meshes),
                   "sweep { case { lattice { imperfection { amplitude_mm: 0.01 } } }"
                   "        axes { field: 'lattice.imperfection.seed' seed_count: " +
                       std::to_string(seeds) + " } }");
}

v1::SweepTable::Row row_of(int elements, int seed, v1::Job::State state, double plateau) {
  v1::SweepTable::Row row;
  row.add_values(elements);
  row.add_values(seed);
  row.mutable_result()->set_state(state);
  auto& summary = *row.mutable_result()->mutable_summary();
  summary.set_plateau_stress_impact_mpa(plateau);
  summary.set_plateau_stress_support_mpa(2.0 * plateau);
  summary.set_absorbed_energy_mj(plateau);
  return row;
}

TEST(SweepConvergence, LeavesOutJobsThatHaveNotSucceededAndPicksTheCoarsestMesh) {
  const auto sweep = sweep_over_meshes({2.0, 4.0, 8.0}, 2).sweep();
  const std::vector<v1::SweepTable::Row> rows = {
      row_of(2, 1, v1::Job::SUCCEEDED, 0.90),  row_of(2, 2, v1::Job::SUCCEEDED, 0.9002),
      row_of(4, 1, v1::Job::SUCCEEDED, 0.98),  row_of(4, 2, v1::Job::SUCCEEDED, 0.9802),
      row_of(8, 1, v1::Job::SUCCEEDED, 0.998), row_of(8, 2, v1::Job::SUCCEEDED, 0.9982),
      row_of(8, 3, v1::Job::FAILED, 5.0),      row_of(8, 4, v1::Job::RUNNING, 5.0)};
  const auto found = jobs::convergence_of(sweep, rows, 0.05);
  EXPECT_EQ(found.elements_per_wall(), 4);
  EXPECT_EQ(found.job_count_left_out(), 2);
  EXPECT_EQ(found.mesh_words(), "elements per wall");
  ASSERT_EQ(found.quantities_size(), 3) << "no run densified";
  const auto& support = found.quantities(1);
  EXPECT_EQ(support.field(), "plateau_stress_support_mpa");
  EXPECT_TRUE(support.decides());
  EXPECT_FALSE(found.quantities(2).decides());
  // Differences of 0.16 and 0.036: the order counts as 2, and the limit lies 0.036 / 3 beyond the finest mesh.
  EXPECT_EQ(support.order(), 2.0);
  EXPECT_NEAR(support.limit(), 2.0 * 1.0041, 1e-9);
  ASSERT_EQ(support.meshes_size(), 3);
  EXPECT_NEAR(support.meshes(0).error_relative(), 1.0 - 0.9001 / 1.0041, 1e-9);
  EXPECT_NEAR(support.meshes(0).uncertainty_relative() * support.limit(), support.interval(), 1e-12);
  EXPECT_GT(support.interval(), 2.0 * 0.02);
  EXPECT_NEAR(support.meshes(1).mean(), 1.9602, 1e-9);
  EXPECT_EQ(support.meshes(2).job_count(), 2);
  EXPECT_FALSE(jobs::convergence_of(sweep, rows, 0.001).has_elements_per_wall());
}

TEST(SweepConvergence, OfSingleRunsOfALatticeHasNoInterval) {
  const auto sweep = sweep_over_meshes({2.0, 4.0}, 1).sweep();
  const auto found =
      jobs::convergence_of(sweep, {row_of(2, 1, v1::Job::SUCCEEDED, 1.0), row_of(4, 1, v1::Job::SUCCEEDED, 1.0)}, 0.5);
  EXPECT_FALSE(found.quantities(0).has_interval());
  EXPECT_FALSE(found.quantities(0).meshes(0).has_uncertainty_relative());
  EXPECT_FALSE(found.has_elements_per_wall());
}

TEST(SweepConvergence, HasEachKindOfWarningOnceWithItsRuns) {
  const auto sweep = sweep_over_meshes({2.0, 4.0}, 2).sweep();
  std::vector<v1::SweepTable::Row> rows = {row_of(2, 1, v1::Job::SUCCEEDED, 0.9), row_of(2, 2, v1::Job::SUCCEEDED, 0.9),
                                           row_of(4, 1, v1::Job::SUCCEEDED, 0.9), row_of(4, 2, v1::Job::FAILED, 0.9)};
  const auto warn = [&rows](std::size_t i, v1::Warning::Kind kind, const std::string& message) {
    auto& warning = *rows[i].mutable_result()->mutable_summary()->add_warnings();
    warning.set_kind(kind);
    warning.set_message(message);
  };
  for (std::size_t i = 1; i < rows.size(); ++i) {
    rows[i].set_job("jobs/" + std::to_string(i));
    warn(i, v1::Warning::ENERGY_DRIFT, "drift of " + std::to_string(i));
  }
  warn(2, v1::Warning::WALLS_NECK, "necks");
  const auto found = jobs::convergence_of(sweep, rows, 0.05);
  ASSERT_EQ(found.warnings_size(), 2);
  EXPECT_EQ(found.warnings(0).warning().message(), "drift of 1");
  ASSERT_EQ(found.warnings(0).runs_size(), 2) << "the last has not succeeded";
  EXPECT_EQ(found.warnings(0).runs(0).job(), "jobs/1");
  EXPECT_EQ(found.warnings(0).runs(0).elements_per_wall(), 2);
  EXPECT_EQ(found.warnings(0).runs(0).seed(), 2U);
  EXPECT_EQ(found.warnings(1).runs(0).elements_per_wall(), 4);
}

TEST(SweepConvergence, OfAFrameHasItsOwnMeasuresAndAnIntervalOfSingleRuns) {
  v1::Sweep sweep;
  sweep.mutable_case_()->mutable_lattice()->mutable_frame();
  auto& axis = *sweep.add_axes();
  axis.set_field(kMesh);
  std::vector<v1::SweepTable::Row> rows;
  for (const int elements : {2, 4, 8}) {
    axis.mutable_list()->add_values(elements);
    auto& row = rows.emplace_back();
    row.add_values(elements);
    row.mutable_result()->set_state(v1::Job::SUCCEEDED);
    auto& summary = *row.mutable_result()->mutable_summary();
    summary.mutable_ledger()->set_work_external_mj(3.0 + 0.4 / elements);
    summary.mutable_fibre_strain()->set_largest(0.02);
  }
  const auto found = jobs::convergence_of(sweep, rows, 0.05);
  EXPECT_EQ(found.mesh_words(), "elements per beam");
  ASSERT_EQ(found.quantities_size(), 2) << "no plateau, and no plastic work";
  EXPECT_EQ(found.quantities(0).field(), "ledger.work_external_mj");
  EXPECT_NEAR(found.quantities(0).limit(), 3.0, 1e-6);
  EXPECT_NEAR(found.quantities(0).interval(), 1.25 * 0.05, 1e-6);
  EXPECT_EQ(found.quantities(1).field(), "fibre_strain.largest");
  EXPECT_EQ(found.elements_per_wall(), 8) << "0.05 / 3 and an interval of 0.0625 / 3";
  EXPECT_FALSE(found.quantities(0).meshes(0).has_scatter_relative());
}

TEST(SweepConvergence, OfASweepOverAnythingElseIsRefused) {
  for (const auto& request : {sweep_of(small_case(), kSpeed, {50.0, 100.0}), [] {
                                auto both = sweep_over_meshes({2.0, 4.0}, 2);
                                both.mutable_sweep()->mutable_axes(1)->set_field("depth_mm");
                                return both;
                              }()}) {
    EXPECT_THROW(jobs::convergence_of(request.sweep(), {}, 0.05), ServiceError);
  }
}

TEST(SeedMeans, CountOnlySucceededJobsAndHaveTheIntervalOfStudent) {
  jobs::SeedMeans means(sweep_over_meshes({2.0, 4.0}, 4).sweep());
  ASSERT_TRUE(means.varies_seed());
  auto warned = row_of(2, 2, v1::Job::SUCCEEDED, 1.1);
  warned.mutable_result()->mutable_summary()->add_warnings();
  warned.mutable_result()->mutable_summary()->mutable_front()->set_shock_mpa(3.0);
  for (const auto& row : {row_of(2, 1, v1::Job::SUCCEEDED, 1.0), row_of(4, 1, v1::Job::RUNNING, 5.0), warned,
                          row_of(2, 3, v1::Job::SUCCEEDED, 1.2), row_of(2, 4, v1::Job::FAILED, 5.0)})
    means.add(row);
  ASSERT_EQ(means.size(), 2U);
  const auto of = means.means(0);
  EXPECT_THAT(of.values(), ElementsAre(2.0));
  EXPECT_THAT((std::array{of.job_count(), of.succeeded_count(), of.failed_count(), of.warned_count()}),
              ElementsAre(4, 3, 1, 1));
  ASSERT_EQ(of.results_size(), 6) << of.DebugString();
  EXPECT_EQ(of.results(0).field(), "plateau_stress_impact_mpa");
  EXPECT_NEAR(of.results(0).mean(), 1.1, 1e-12);
  EXPECT_NEAR(of.results(0).deviation(), 0.1, 1e-12);
  EXPECT_NEAR(of.results(0).interval(), 4.30265 * 0.1 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(of.results(3).field(), "front.shock_mpa");
  EXPECT_EQ(of.results(3).job_count(), 1);
  EXPECT_FALSE(of.results(3).has_interval());
  EXPECT_EQ(means.means(1).job_count(), 1);
  EXPECT_EQ(means.means(1).results_size(), 0);
}

class ConvergenceServiceTest : public DaemonFixture {};

TEST_F(ConvergenceServiceTest, IsThatOfTheTableAndItsCostIsToldBefore) {
  auto client = this->client();
  auto request = sweep_over_meshes({1.0, 2.0}, 2);
  request.set_validate_only(true);
  const double predicted = create(client, request).predicted_seconds();
  EXPECT_GT(predicted, 0.0);
  request.set_validate_only(false);
  const auto sweep = create(client, request);
  EXPECT_EQ(sweep.predicted_seconds(), predicted);
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, 4));
  auto asked = named<v1::GetConvergenceRequest>(sweep.name());
  const auto found = answer_of(*client.sweeps, &v1::Sweeps::Stub::GetConvergence, asked);
  EXPECT_EQ(found.wanted_error_relative(), 0.05);
  ASSERT_GE(found.quantities_size(), 3);
  const auto& coarse = found.quantities(0).meshes(0);
  const double first = client.get(sweep.jobs(0)).summary().plateau_stress_impact_mpa();
  const double second = client.get(sweep.jobs(1)).summary().plateau_stress_impact_mpa();
  EXPECT_NEAR(coarse.mean(), 0.5 * (first + second), 1e-9);
  EXPECT_NEAR(coarse.scatter_relative() * coarse.mean(), std::abs(first - second) / std::sqrt(2.0), 1e-9);
  auto averaged = named<v1::GetSweepTableRequest>(sweep.name());
  averaged.set_mean_over_seeds(true);
  averaged.set_page_size(1);
  auto table = answer_of(*client.sweeps, &v1::Sweeps::Stub::GetSweepTable, averaged);
  EXPECT_THAT(table.fields(), ElementsAre(kMesh, "lattice.imperfection.seed"));
  ASSERT_EQ(table.means_size(), 1);
  EXPECT_EQ(table.rows_size(), 0);
  EXPECT_EQ(table.means(0).succeeded_count(), 2);
  EXPECT_EQ(table.means(0).results(0).mean(), coarse.mean());
  averaged.set_page_token(table.next_page_token());
  table = answer_of(*client.sweeps, &v1::Sweeps::Stub::GetSweepTable, averaged);
  EXPECT_THAT(table.means(0).values(), ElementsAre(2.0));
  EXPECT_TRUE(table.next_page_token().empty());
  asked.set_wanted_error_relative(-0.1);
  const auto refused = try_call(*client.sweeps, &v1::Sweeps::Stub::GetConvergence, asked);
  EXPECT_THAT(refused, Fails(grpc::StatusCode::INVALID_ARGUMENT, "wanted_error_relative"));
  asked.set_name("sweeps/99");
  asked.set_wanted_error_relative(0.1);
  EXPECT_EQ(try_call(*client.sweeps, &v1::Sweeps::Stub::GetConvergence, asked).error_code(),
            grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace cellcrush::testing
