#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "google/rpc/status.pb.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

class JobsServiceTest : public DaemonFixture {
 protected:
  [[nodiscard]] std::string result_path(const std::string& job) const {
    return (data_folder() / job / "result.h5").string();
  }

  // Runs the small case to its end.
  std::string finished_job() {
    auto client = this->client();
    std::string job = client.create(small_case());
    EXPECT_TRUE(client.watch(job).status.ok());
    EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << client.get(job).cause_message();
    return job;
  }

  grpc::Status frame_of(const v1::GetFrameRequest& request, v1::FieldFrame& frame, v1::Mesh& mesh) {
    auto client = this->client();
    const auto context = bounded_context();
    const auto reader = client.jobs->GetFrame(context.get(), request);
    v1::GetFrameResponse response;
    while (reader->Read(&response)) {
      mesh.MergeFrom(response.mesh().mesh());
      frame.MergeFrom(response.chunk().frame());
    }
    return reader->Finish();
  }
};

TEST_F(JobsServiceTest, ARefusedCaseCarriesItsProblemsAndQueuesNothing) {
  auto client = this->client();
  v1::CreateJobRequest request;
  *request.mutable_case_() = small_case();
  request.mutable_case_()->set_depth_mm(-1.0);
  request.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_rows(0);
  v1::Job job;
  const auto status = client.jobs->CreateJob(bounded_context().get(), request, &job);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  v1::ProblemList list;
  ASSERT_TRUE(details.details(1).UnpackTo(&list));
  EXPECT_EQ(list.problems_size(), 2);
  v1::ListJobsResponse listed;
  ASSERT_TRUE(client.jobs->ListJobs(bounded_context().get(), {}, &listed).ok());
  EXPECT_EQ(listed.jobs_size(), 0);
}

TEST_F(JobsServiceTest, ValidateOnlyQueuesNothing) {
  auto client = this->client();
  v1::CreateJobRequest request;
  *request.mutable_case_() = small_case();
  request.set_validate_only(true);
  v1::Job job;
  ASSERT_TRUE(client.jobs->CreateJob(bounded_context().get(), request, &job).ok());
  EXPECT_TRUE(job.name().empty());
  v1::ListJobsResponse listed;
  ASSERT_TRUE(client.jobs->ListJobs(bounded_context().get(), {}, &listed).ok());
  EXPECT_EQ(listed.jobs_size(), 0);
}

TEST_F(JobsServiceTest, ARequestIdMakesOneJob) {
  auto client = this->client();
  v1::CreateJobRequest request;
  *request.mutable_case_() = small_case();
  (*request.mutable_labels())["a"] = "b";
  request.set_request_id("the same");
  v1::Job first;
  v1::Job second;
  ASSERT_TRUE(client.jobs->CreateJob(bounded_context().get(), request, &first).ok());
  ASSERT_TRUE(client.jobs->CreateJob(bounded_context().get(), request, &second).ok());
  EXPECT_EQ(first.name(), second.name());
  EXPECT_EQ(second.labels().at("a"), "b");
  request.mutable_case_()->set_title("another");
  EXPECT_EQ(client.jobs->CreateJob(bounded_context().get(), request, &second).error_code(),
            grpc::StatusCode::ALREADY_EXISTS);
  request.set_request_id(std::string(129, 'x'));
  EXPECT_EQ(client.jobs->CreateJob(bounded_context().get(), request, &second).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(JobsServiceTest, UnknownNamesAreNotFound) {
  auto client = this->client();
  for (const char* name : {"jobs/77", "nonsense", ""}) {
    v1::GetJobRequest request;
    request.set_name(name);
    v1::Job job;
    EXPECT_EQ(client.jobs->GetJob(bounded_context().get(), request, &job).error_code(), grpc::StatusCode::NOT_FOUND);
    EXPECT_EQ(client.watch(name).status.error_code(), grpc::StatusCode::NOT_FOUND);
    grpc::Status status;
    client.download(name, 0, status);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
    EXPECT_EQ(client.cancel(name).error_code(), grpc::StatusCode::NOT_FOUND);
    EXPECT_EQ(client.remove(name).error_code(), grpc::StatusCode::NOT_FOUND);
  }
}

TEST_F(JobsServiceTest, ADownloadIsTheFileFromAnyOffset) {
  const std::string job = finished_job();
  auto client = this->client();
  std::ifstream file(result_path(job), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(bytes.size(), 10'000U);
  grpc::Status status;
  for (const std::size_t offset : {std::size_t{0}, std::size_t{4567}, bytes.size()}) {
    EXPECT_EQ(client.download(job, static_cast<std::int64_t>(offset), status), bytes.substr(offset)) << offset;
    EXPECT_TRUE(status.ok()) << status.error_message();
  }
  client.download(job, static_cast<std::int64_t>(bytes.size()) + 1, status);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::OUT_OF_RANGE);
  client.download(job, -1, status);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(JobsServiceTest, ThereIsNoDownloadBeforeTheEnd) {
  auto client = this->client();
  const std::string job = client.create(endless_case());
  grpc::Status status;
  client.download(job, 0, status);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(JobsServiceTest, TheResultHoldsWhatTheHistorySays) {
  const std::string job = finished_job();
  auto client = this->client();
  v1::GetHistoryRequest request;
  request.set_name(job);
  v1::GetHistoryResponse history;
  ASSERT_TRUE(client.jobs->GetHistory(bounded_context().get(), request, &history).ok());
  const store::ResultReader result(result_path(job));
  const auto stored = result.history();
  ASSERT_EQ(static_cast<int>(stored.size()), history.samples_size());
  EXPECT_GE(stored.size(), 90U);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    EXPECT_EQ(stored[i].strain(), history.samples(static_cast<int>(i)).strain());
    EXPECT_EQ(stored[i].stress_impact_mpa(), history.samples(static_cast<int>(i)).stress_impact_mpa());
  }
  const auto finished = client.get(job);
  EXPECT_NEAR(stored.back().strain(), small_case().loading().end_strain(), 1e-3);
  EXPECT_GT(finished.summary().plateau_stress_impact_mpa(), 0.0);
  EXPECT_GT(finished.summary().solver_seconds(), 0.0);
  EXPECT_GT(finished.summary().stage_times().evaluate_internal_forces_s(), 0.0);
}

TEST_F(JobsServiceTest, FramesAreFoundByIndexStrainAndTime) {
  const std::string job = finished_job();
  const store::ResultReader result(result_path(job));
  const int last = static_cast<int>(result.frame_times().size()) - 1;
  ASSERT_GE(last, 9);
  v1::GetFrameRequest request;
  request.set_name(job);
  const auto index = [&] {
    v1::FieldFrame frame;
    v1::Mesh mesh;
    const auto status = frame_of(request, frame, mesh);
    EXPECT_TRUE(status.ok()) << status.error_message();
    EXPECT_EQ(frame.position_mm_size(), 2 * mesh.particle_count());
    EXPECT_EQ(frame.plastic_fraction_size(), mesh.thickness_mm_size());
    return frame.index();
  };
  EXPECT_EQ(index(), last);
  request.set_index(0);
  EXPECT_EQ(index(), 0);
  request.set_index(-1);
  EXPECT_EQ(index(), last);
  request.set_strain(result.frame_strains()[3] + 1e-4);
  EXPECT_EQ(index(), 3);
  request.set_time_s(result.frame_times()[5]);
  EXPECT_EQ(index(), 5);
  request.set_index(last + 1);
  v1::FieldFrame frame;
  v1::Mesh mesh;
  EXPECT_EQ(frame_of(request, frame, mesh).error_code(), grpc::StatusCode::OUT_OF_RANGE);
}

TEST_F(JobsServiceTest, ARunningJobShowsItsNewestFrameAndProgress) {
  auto client = this->client();
  const std::string job = client.create(endless_case());
  bool progressed = false;
  for (int i = 0; i < 200 && !progressed; ++i) {
    progressed = client.get(job).progress().step() > 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_TRUE(progressed);
  EXPECT_GT(client.get(job).worker_pid(), 0);
  v1::GetFrameRequest request;
  request.set_name(job);
  v1::FieldFrame frame;
  v1::Mesh mesh;
  const auto status = frame_of(request, frame, mesh);
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(frame.position_mm_size(), 2 * mesh.particle_count());
  EXPECT_GT(mesh.particle_count(), 1000);
}

}  // namespace
}  // namespace cellcrush::testing
