#include <gmock/gmock.h>

#include "server/gate_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

class OwnerTest : public GateFixture {};

/// Calls of one owner.
class Owner {
 public:
  Owner(const std::shared_ptr<grpc::Channel>& channel, std::string token)
      : jobs_(v1::Jobs::NewStub(channel)), sweeps_(v1::Sweeps::NewStub(channel)), token_(std::move(token)) {}

  v1::Job create(const v1::Case& submitted, const std::string& request_id = "") {
    v1::CreateJobRequest request;
    *request.mutable_case_() = submitted;
    request.set_request_id(request_id);
    v1::Job out;
    last = jobs_->CreateJob(context().get(), request, &out);
    return out;
  }
  v1::Sweep create_sweep() {
    v1::CreateSweepRequest request;
    request.mutable_sweep()->set_owner("someone-else");
    *request.mutable_sweep()->mutable_case_() = small_case();
    auto& axis = *request.mutable_sweep()->add_axes();
    axis.set_field("loading.speed_m_per_s");
    axis.mutable_list()->add_values(100.0);
    v1::Sweep out;
    last = sweeps_->CreateSweep(context().get(), request, &out);
    return out;
  }
  /// Codes of cancel, suspend, resume and delete of a job.
  std::vector<grpc::StatusCode> change(const std::string& name) {
    v1::Job job;
    v1::DeleteJobResponse deleted;
    return {jobs_->CancelJob(context().get(), named<v1::CancelJobRequest>(name), &job).error_code(),
            jobs_->SuspendJob(context().get(), named<v1::SuspendJobRequest>(name), &job).error_code(),
            jobs_->ResumeJob(context().get(), named<v1::ResumeJobRequest>(name), &job).error_code(),
            jobs_->DeleteJob(context().get(), named<v1::DeleteJobRequest>(name), &deleted).error_code()};
  }
  /// Codes of cancel and retry of a sweep.
  std::vector<grpc::StatusCode> change_sweep(const std::string& name) {
    v1::Sweep sweep;
    return {sweeps_->CancelSweep(context().get(), named<v1::CancelSweepRequest>(name), &sweep).error_code(),
            sweeps_->RetryFailedJobs(context().get(), named<v1::RetryFailedJobsRequest>(name), &sweep).error_code()};
  }
  int count(const std::string& filter) {
    v1::ListJobsRequest request;
    request.set_filter(filter);
    v1::ListJobsResponse response;
    last = jobs_->ListJobs(context().get(), request, &response);
    return response.jobs_size();
  }

  grpc::Status last;

 private:
  template <class Request>
  static Request named(const std::string& name) {
    Request out;
    out.set_name(name);
    return out;
  }
  [[nodiscard]] std::unique_ptr<grpc::ClientContext> context() const {
    auto out = bounded_context();
    if (!token_.empty()) out->AddMetadata("authorization", "Bearer " + token_);
    return out;
  }

  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Sweeps::Stub> sweeps_;
  std::string token_;
};

TEST_F(OwnerTest, AnOwnerIsKeptAndAloneChangesWhatIsHis) {
  using Codes = std::vector<grpc::StatusCode>;
  const auto denied = grpc::StatusCode::PERMISSION_DENIED;
  start(with_tokens(tcp_options()));
  std::string job;
  std::string sweep;
  {
    Owner anna(channel({}), tokens_.at("anna"));
    job = anna.create(small_case(), "once").name();
    ASSERT_TRUE(anna.last.ok()) << anna.last.error_message();
    const auto made = anna.create_sweep();
    EXPECT_EQ(made.owner(), "anna") << "What the request says is not believed.";
    sweep = made.name();
    ASSERT_TRUE(client().watch(job).status.ok());
    EXPECT_EQ(anna.create(small_case(), "once").name(), job);
  }
  start(with_tokens(tcp_options()));
  EXPECT_EQ(client().get(job).owner(), "anna");
  Owner bob(channel({}), tokens_.at("bob"));
  EXPECT_EQ(bob.change(job), (Codes{denied, denied, denied, denied}));
  EXPECT_EQ(bob.change_sweep(sweep), (Codes{denied, denied}));
  static_cast<void>(bob.create(small_case(), "once"));
  EXPECT_EQ(bob.last.error_code(), grpc::StatusCode::ALREADY_EXISTS) << "Nobody is given another's job as his own.";
  EXPECT_EQ(bob.count("owner = anna"), 2);
  EXPECT_EQ(bob.count("owner = \"bob\""), 0);
  Owner anna(channel({}), tokens_.at("anna"));
  EXPECT_EQ(anna.change(job).back(), grpc::StatusCode::OK);
  EXPECT_EQ(anna.change_sweep(sweep), (Codes{grpc::StatusCode::OK, grpc::StatusCode::OK}));
  Owner local(grpc::CreateChannel(daemon_->addresses().front(), grpc::InsecureChannelCredentials()), "");
  const std::string of_local = local.create(small_case()).name();
  EXPECT_EQ(client().get(of_local).owner(), "local");
  ASSERT_TRUE(client().watch(of_local).status.ok());
  EXPECT_EQ(anna.change(of_local).back(), denied);
  Owner chief(channel({}), tokens_.at("chief"));
  EXPECT_EQ(chief.change(of_local).back(), grpc::StatusCode::OK);
}

}  // namespace
}  // namespace cellcrush::testing
