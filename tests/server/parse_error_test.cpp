#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <grpcpp/generic/generic_stub.h>

#include "cellcrush/v1/admin_service.pb.h"
#include "google/rpc/status.pb.h"
#include "server/daemon_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

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
