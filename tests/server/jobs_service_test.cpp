#include <gmock/gmock.h>

#include "google/rpc/status.pb.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"
#include "store/result_reader.h"

namespace cellcrush::testing {
namespace {

class JobsServiceTest : public DaemonFixture {
 protected:
  [[nodiscard]] std::string result_path(const std::string& job) const {
    return (data_folder() / job / "result.h5").string();
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
  auto request = job_of(small_case());
  request.mutable_case_()->set_depth_mm(-1.0);
  request.mutable_case_()->mutable_lattice()->mutable_hexagon()->set_rows(0);
  const auto status = client.try_to(request);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  v1::ProblemList list;
  ASSERT_TRUE(details.details(1).UnpackTo(&list));
  EXPECT_EQ(list.problems_size(), 2);
  EXPECT_TRUE(client.list().empty());
}

TEST_F(JobsServiceTest, ValidateOnlyQueuesNothing) {
  auto client = this->client();
  auto request = job_of(small_case());
  request.set_validate_only(true);
  EXPECT_TRUE(client.create(request).name().empty());
  EXPECT_TRUE(client.list().empty());
}

TEST_F(JobsServiceTest, ARequestIdMakesOneJob) {
  auto client = this->client();
  auto request = job_of(small_case());
  (*request.mutable_labels())["a"] = "b";
  request.set_request_id("the same");
  const auto first = client.create(request);
  const auto second = client.create(request);
  EXPECT_EQ(first.name(), second.name());
  EXPECT_EQ(second.labels().at("a"), "b");
  request.mutable_case_()->set_title("another");
  EXPECT_EQ(client.try_to(request).error_code(), grpc::StatusCode::ALREADY_EXISTS);
  request.set_request_id(std::string(129, 'x'));
  EXPECT_EQ(client.try_to(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
}

TEST_F(JobsServiceTest, UnknownNamesAreNotFound) {
  auto client = this->client();
  for (const char* name : {"jobs/77", "nonsense", ""}) {
    EXPECT_EQ(try_call(*client.jobs, &v1::Jobs::Stub::GetJob, named<v1::GetJobRequest>(name)).error_code(),
              grpc::StatusCode::NOT_FOUND);
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
  const std::string bytes = text_of_file(result_path(job));
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

TEST_F(JobsServiceTest, FramesAreFoundByIndexStrainAndTime) {
  const std::string job = finished_job();
  const store::ResultReader result(result_path(job));
  const int last = static_cast<int>(result.frame_times().size()) - 1;
  ASSERT_GE(last, 9);
  auto request = named<v1::GetFrameRequest>(job);
  const auto index = [&] {
    v1::FieldFrame frame;
    v1::Mesh mesh;
    const auto status = frame_of(request, frame, mesh);
    EXPECT_TRUE(status.ok()) << status.error_message();
    EXPECT_EQ(frame.position_mm_size(), 2 * mesh.particle_count());
    EXPECT_EQ(frame.plastic_fraction_size(), mesh.thickness_mm_size());
    for (const int node : mesh.element_nodes()) EXPECT_TRUE(node >= 0 && node < mesh.particle_count()) << node;
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
  EXPECT_TRUE(wait_until([&] { return client.get(job).progress().step() > 0; }));
  EXPECT_GT(client.get(job).worker_pid(), 0);
  v1::FieldFrame frame;
  v1::Mesh mesh;
  const auto status = frame_of(named<v1::GetFrameRequest>(job), frame, mesh);
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(frame.position_mm_size(), 2 * mesh.particle_count());
  EXPECT_GT(mesh.particle_count(), 1000);
  grpc::Status refused;
  client.download(job, 0, refused);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::FAILED_PRECONDITION) << "There is no result before the end.";
}

}  // namespace
}  // namespace cellcrush::testing
