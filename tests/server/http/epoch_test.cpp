// No command reaches the job of another server: one that came back at the same address with another data folder, or on
// a backup.
#include <gmock/gmock.h>

#include "server/http/http_fixture.h"
#include "server/small_case.h"
#include "store/backup.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kHeader = "cellcrush-epoch";

class EpochTest : public HttpFixture {
 protected:
  void SetUp() override {
    HttpFixture::SetUp();
    start(http_options());
    job_ = client().create(tiny_case(), v1::Job::SUCCEEDED);
    first_ = epoch();
  }

  // As a client without one sees it in an answer.
  [[nodiscard]] std::string epoch() const {
    const auto context = bounded_context();
    v1::ListJobsResponse answer;
    EXPECT_TRUE(client().jobs->ListJobs(context.get(), {}, &answer).ok());
    const auto found = context->GetServerInitialMetadata().find(kHeader);
    return found == context->GetServerInitialMetadata().end() ? ""
                                                              : std::string(found->second.data(), found->second.size());
  }

  void come_back_with(const std::string& folder) {
    auto options = http_options();
    options.data_folder = folder_.path() / folder;
    start(options);
  }

  template <class Stub, class Request, class Response>
  static grpc::Status call_for(const std::string& epoch, Stub& stub,
                               grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                               const std::type_identity_t<Request>& request) {
    const auto context = bounded_context();
    context->AddMetadata(kHeader, epoch);
    Response answer;
    return (stub.*method)(context.get(), request, &answer);
  }

  std::string job_;
  std::string first_;
};

TEST_F(EpochTest, ACallForTheFormerServerIsRefusedAndTheJobOfTheSameNameStands) {
  come_back_with("second");
  auto now = client();
  const std::string second = epoch();
  ASSERT_EQ(now.create(tiny_case(), v1::Job::SUCCEEDED), job_);
  const auto request = named<v1::DeleteJobRequest>(job_);
  const auto refused = call_for(first_, *now.jobs, &v1::Jobs::Stub::DeleteJob, request);
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, "This is another server, or another data folder"));
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, "epoch " + first_ + ", this"));
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, "has epoch " + second + "."));
  EXPECT_EQ(now.get(job_).state(), v1::Job::SUCCEEDED);
  const auto context = bounded_context();
  context->AddMetadata(kHeader, first_);
  const auto watch = now.jobs->WatchJob(context.get(), named<v1::WatchJobRequest>(job_));
  v1::JobEvent event;
  EXPECT_FALSE(watch->Read(&event));
  EXPECT_THAT(watch->Finish(), Fails(grpc::StatusCode::FAILED_PRECONDITION, "another server"));
  EXPECT_TRUE(call_for(second, *now.jobs, &v1::Jobs::Stub::DeleteJob, request).ok());
}

TEST_F(EpochTest, ARestartKeepsTheEpochACopyAndARestoreHaveOthers) {
  daemon_.reset();
  std::filesystem::copy(data_folder(), folder_.path() / "copy", std::filesystem::copy_options::recursive);
  come_back_with("copy");
  EXPECT_NE(epoch(), first_);
  daemon_.reset();
  std::filesystem::rename(data_folder(), folder_.path() / "moved");
  come_back_with("moved");
  EXPECT_EQ(epoch(), first_);
  daemon_.reset();
  std::filesystem::rename(folder_.path() / "moved", data_folder());
  start(http_options());
  store::take_backup(data_folder(), folder_.path() / "backup");
  store::restore_backup(folder_.path() / "backup", folder_.path() / "restored");
  come_back_with("restored");
  auto now = client();
  const auto refused = call_for(first_, *now.jobs, &v1::Jobs::Stub::DeleteJob, named<v1::DeleteJobRequest>(job_));
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, ", since the restore of 20"));
  EXPECT_EQ(now.get(job_).state(), v1::Job::SUCCEEDED);
}

TEST_F(EpochTest, EveryMethodOverHttpIsRefusedForAnotherEpoch) {
  const std::string other = std::string(kHeader) + ": 0123456789abcdef\r\n";
  const auto* file = v1::Job::descriptor()->file()->pool();
  for (const char* name : {"Cases", "Jobs", "Sweeps", "Admin"}) {
    const auto* service = file->FindServiceByName("cellcrush.v1." + std::string(name));
    for (int i = 0; i < service->method_count(); ++i) {
      const auto& method = *service->method(i);
      const bool streams = method.server_streaming();
      const std::string type = streams ? "application/connect+json" : "application/json";
      const std::string answer =
          exchange(request("POST /" + service->full_name() + "/" + method.name(),
                           "Content-Type: " + type + "\r\n" + other, streams ? envelope("{}") : "{}"));
      EXPECT_THAT(answer, AllOf(HasSubstr("failed_precondition"), HasSubstr("epoch 0123456789abcdef, this"),
                                HasSubstr(std::string(kHeader) + ": " + first_)))
          << method.full_name();
    }
  }
  const auto file_of_job = [&](const std::string& headers) {
    return exchange(request("GET /" + job_ + "/history.csv", headers));
  };
  EXPECT_THAT(file_of_job(other), AllOf(StartsWith("HTTP/1.1 400"), HasSubstr("another server")));
  for (const std::string& headers : {std::string(), std::string(kHeader) + ": " + first_ + "\r\n"})
    EXPECT_THAT(file_of_job(headers), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(file_of_job(std::string(kHeader) + ": \xff\"\r\n"), Not(HasSubstr("\xff")));
}

}  // namespace
}  // namespace cellcrush::testing
