// Requests that are too large, or no messages.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <grpcpp/generic/generic_stub.h>

#include "cellcrush/v1/admin_service.pb.h"
#include "google/rpc/status.pb.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "translate/check_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class RequestLimitsTest : public DaemonFixture {
 protected:
  static void expect_refusal(const grpc::Status& status, const std::string& words) {
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << words;
    EXPECT_THAT(status.error_message(), HasSubstr(words));
    EXPECT_LT(status.error_message().size(), 1000U);
  }
};

TEST_F(RequestLimitsTest, TooLongTextsAreRefusedByTheirField) {
  const Client daemon = client();
  const std::string long_text(1'000'000, 'a');
  expect_refusal(try_call(*daemon.jobs, &v1::Jobs::Stub::GetJob, named<v1::GetJobRequest>("jobs/" + long_text)),
                 "name has 1000005 bytes. Use at most 128.");
  expect_refusal(try_call(*daemon.sweeps, &v1::Sweeps::Stub::GetSweep, named<v1::GetSweepRequest>(long_text)),
                 "name has 1000000 bytes");
  expect_refusal(try_call(*daemon.cases, &v1::Cases::Stub::GetPreset, named<v1::GetPresetRequest>(long_text)),
                 "name has 1000000 bytes");
  for (const char* field : {"filter", "order_by", "page_token"}) {
    v1::ListJobsRequest list;
    list.GetReflection()->SetString(&list, list.GetDescriptor()->FindFieldByName(field), long_text);
    expect_refusal(daemon.try_to(list), field + std::string(" has 1000000"));
  }
  auto create = job_of(small_case());
  create.set_request_id(long_text);
  expect_refusal(daemon.try_to(create), "request_id");
  create.clear_request_id();
  (*create.mutable_labels())[long_text] = "value";
  expect_refusal(daemon.try_to(create), "labels");
  auto watch = named<v1::WatchSweepRequest>("sweeps/1");
  watch.set_resume_token(long_text);
  const auto context = bounded_context();
  const auto stream = daemon.sweeps->WatchSweep(context.get(), watch);
  v1::WatchSweepResponse event;
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_THAT(stream->Finish(), Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "Use at most 262144"));
}

TEST_F(RequestLimitsTest, ASweepOverManyFieldsIsRefused) {
  const Client daemon = client();
  v1::CreateSweepRequest request;
  *request.mutable_sweep()->mutable_case_() = small_case();
  for (int i = 0; i < 33; ++i) {
    auto& axis = *request.mutable_sweep()->add_axes();
    axis.set_field("field" + std::to_string(i));
    axis.mutable_list()->add_values(1.0);
  }
  expect_refusal(daemon.try_to(request), "vary 33 fields");
  expect_refusal(daemon.try_to(sweep_of(small_case(), std::string(100'000, 'a'), {1.0})), "field of 100000 bytes");
}

// Two bytes of a message make an entry with several problems: nothing may grow with them.
TEST(CaseLimits, MillionsOfEmptyEntriesAreRefusedByTheirNumber) {
  v1::Case submitted = small_case();
  auto& frame = *submitted.mutable_lattice()->mutable_frame();
  for (int i = 0; i < 2'000'000; ++i) frame.add_beams();
  const auto response = translate::check_case(submitted).response;
  ASSERT_EQ(response.problems_size(), 1);
  EXPECT_EQ(response.problems(0).field(), "lattice.frame.beams");
  EXPECT_EQ(response.problems(0).remedy(), "Give at most 200000.");
}

TEST(CaseLimits, OfVeryManyProblemsTheRestIsCounted) {
  v1::Case submitted = small_case();
  auto& frame = *submitted.mutable_lattice()->mutable_frame();
  for (int i = 0; i < 10'000; ++i) {
    auto& motion = *frame.add_motions();
    motion.set_node("a");
    motion.set_component(v1::Frame::COMPONENT_X);
  }
  const auto response = translate::check_case(submitted).response;
  ASSERT_EQ(response.problems_size(), 1001);
  EXPECT_THAT(response.problems(1000).message(), HasSubstr("more problems."));
}

class ParseErrorTest : public DaemonFixture {
 protected:
  /// How a unary or server-streaming call ends whose message is these bytes.
  [[nodiscard]] grpc::Status send(const std::string& path, const std::string& bytes) const {
    grpc::GenericStub stub(client().channel);
    grpc::CompletionQueue queue;
    const auto context = bounded_context(std::chrono::seconds(20));
    const auto call = stub.PrepareCall(context.get(), path, &queue);
    const auto wait = [&queue] {
      void* tag = nullptr;
      bool ok = false;
      return queue.Next(&tag, &ok) && ok;
    };
    call->StartCall(nullptr);
    wait();
    const grpc::Slice slice(bytes);
    call->WriteLast(grpc::ByteBuffer(&slice, 1), grpc::WriteOptions(), nullptr);
    wait();
    grpc::ByteBuffer answer;
    do call->Read(&answer, nullptr);
    while (wait());
    grpc::Status status;
    call->Finish(&status, nullptr);
    wait();
    return status;
  }
};

TEST_F(ParseErrorTest, EveryMethodNamesItsMessageWhenTheBytesAreNone) {
  int methods = 0;
  for (const auto* file : {v1::CheckCaseRequest::descriptor()->file(), v1::GetJobRequest::descriptor()->file(),
                           v1::GetSweepRequest::descriptor()->file(), v1::DrainRequest::descriptor()->file()}) {
    const auto& service = *file->service(0);
    for (int i = 0; i < service.method_count(); ++i, ++methods) {
      const auto& method = *service.method(i);
      const auto status = send("/" + service.full_name() + "/" + method.name(), "\xff");
      EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << method.full_name();
      EXPECT_THAT(status.error_message(),
                  HasSubstr(method.full_name() + " is not a " + method.input_type()->full_name()));
      google::rpc::Status details;
      EXPECT_TRUE(details.ParseFromString(status.error_details()));
      EXPECT_EQ(details.code(), grpc::StatusCode::INVALID_ARGUMENT) << method.full_name();
    }
  }
  EXPECT_GT(methods, 20);
}

TEST_F(ParseErrorTest, ATextThatIsNotUtf8IsRefusedInUnaryStreamingAndWatchCalls) {
  for (const char* method : {"GetJob", "DownloadResult", "WatchJob"}) {
    const auto status = send(std::string("/cellcrush.v1.Jobs/") + method, "\x0a\x01\xff");
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << method;
    EXPECT_THAT(status.error_message(), HasSubstr("every string as UTF-8"));
  }
}

TEST_F(ParseErrorTest, OtherErrorsStayAsTheyAre) {
  EXPECT_EQ(send("/cellcrush.v1.Jobs/GetJob", "\x0a\x06jobs/9").error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(send("/cellcrush.v1.Jobs/WatchJob", "\x0a\x06jobs/9").error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(send("/cellcrush.v1.Jobs/Unknown", "\xff").error_code(), grpc::StatusCode::UNIMPLEMENTED);
}

}  // namespace
}  // namespace cellcrush::testing
