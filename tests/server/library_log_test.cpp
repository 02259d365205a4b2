#include <gmock/gmock.h>
#include <grpc/support/log.h>

#include <chrono>

#include "cellcrush/v1/jobs_service.pb.h"
#include "limited_log.h"
#include "log_format.h"
#include "server/log_capture.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class LibraryLog : public ::testing::Test {
 protected:
  void SetUp() override {
    gpr_log_verbosity_init();  // as grpc_init does
    redirect_library_logs();
  }
};

TEST_F(LibraryLog, LinesOfGrpcAndProtobufAreThoseOfTheDaemon) {
  const LogCapture log(make_text_formatter());
  gpr_log(GPR_ERROR, "value=%s", "x\n[2030-01-01] [info] jobs/9 deleted by root\xff");
  EXPECT_EQ(log.count_lines("[error] gRPC: value=x\\x0a[2030-01-01] [info] jobs/9 deleted by root\\xff"), 1)
      << log.text();
  v1::GetJobRequest request;
  EXPECT_FALSE(request.ParseFromString("\x0a\x01\xff"));
  EXPECT_EQ(log.count_lines("[error] protobuf: String field 'cellcrush.v1.GetJobRequest.name' contains invalid UTF-8"),
            1)
      << log.text();
}

TEST_F(LibraryLog, AFloodIsLimitedAndALongLineCut) {
  const LogCapture log(make_text_formatter());
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 5000; ++i) gpr_log(GPR_ERROR, "%s", std::string(2000, 'x').c_str());
  const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(log.count_lines("gRPC: "), 1);
  EXPECT_LE(log.count_lines("gRPC: "), 10 * (2 + static_cast<int>(seconds)));
  EXPECT_THAT(log.text(), Not(HasSubstr(std::string(501, 'x'))));
}

}  // namespace
}  // namespace cellcrush::testing
