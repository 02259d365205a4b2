#include "jobs/convergence.h"

#include <gmock/gmock.h>

#include <cmath>

#include "error.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kMesh = "elements_per_wall";
constexpr const char* kSeed = "lattice.imperfection.seed";

v1::CreateSweepRequest sweep_over_meshes(const std::vector<double>& meshes, int seeds) {
  auto request = sweep_of(small_case(), kMesh, meshes);
  auto& sweep = *request.mutable_sweep();
  sweep.mutable_case_()->mutable_lattice()->mutable_imperfection()->set_amplitude_mm(0.01);
  auto& axis = *sweep.add_axes();
  axis.set_field(kSeed);
  axis.set_seed_count(seeds);
  return request;
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
      row_of(2, 1, v1::Job::SUCCEEDED, 0.90), row_of(2, 2, v1::Job::SUCCEEDED, 0.9002),
      row_of(4, 1, v1::Job::SUCCEEDED, 0.98), row_of(4, 2, v1::Job::SUCCEEDED, 0.9802),
      row_of(8, 1, v1::Job::SUCCEEDED, 1.00), row_of(8, 2, v1::Job::SUCCEEDED, 1.0002),
      row_of(8, 3, v1::Job::FAILED, 5.0),     row_of(8, 4, v1::Job::RUNNING, 5.0)};
  const auto found = jobs::convergence_of(sweep, rows, 0.05);
  EXPECT_EQ(found.elements_per_wall(), 4);
  EXPECT_EQ(found.job_count_left_out(), 2);
  ASSERT_EQ(found.quantities_size(), 3) << "no run densified";
  const auto& support = found.quantities(1);
  EXPECT_EQ(support.field(), "plateau_stress_support_mpa");
  ASSERT_EQ(support.meshes_size(), 3);
  EXPECT_NEAR(support.meshes(0).error_relative(), 0.1, 1e-3);
  EXPECT_NEAR(support.meshes(1).mean(), 1.9602, 1e-9);
  EXPECT_EQ(support.meshes(2).job_count(), 2);
  EXPECT_FALSE(jobs::convergence_of(sweep, rows, 0.001).has_elements_per_wall());
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
  asked.set_wanted_error_relative(-0.1);
  const auto refused = try_call(*client.sweeps, &v1::Sweeps::Stub::GetConvergence, asked);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(refused.error_message(), HasSubstr("wanted_error_relative"));
  asked.set_name("sweeps/99");
  asked.set_wanted_error_relative(0.1);
  EXPECT_EQ(try_call(*client.sweeps, &v1::Sweeps::Stub::GetConvergence, asked).error_code(),
            grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace cellcrush::testing
