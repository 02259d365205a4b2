// The form of the log's lines, what they tell of changes, and lines of the libraries among them.
#include <gmock/gmock.h>
#include <grpc/support/log.h>
#include <spdlog/details/log_msg.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <string>

#include "cellcrush/v1/jobs_service.pb.h"
#include "limited_log.h"
#include "log_format.h"
#include "rpc/request_fields.h"
#include "server/log_capture.h"

namespace cellcrush::testing {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

std::string json_line_of(const std::string& message) {
  const spdlog::log_clock::time_point time{std::chrono::milliseconds(1'700'000'000'042)};
  const spdlog::details::log_msg log(time, {}, "name", spdlog::level::warn, message);
  spdlog::memory_buf_t line;
  make_json_formatter()->format(log, line);
  return {line.data(), line.size()};
}

TEST(LogFormat, ALineIsAnObjectWithTheJobItIsAbout) {
  EXPECT_EQ(json_line_of("jobs/12: lost"),
            "{\"time\":\"2023-11-14T22:13:20.042Z\",\"level\":\"warning\",\"job\":\"jobs/12\","
            "\"message\":\"jobs/12: lost\"}\n");
  EXPECT_EQ(json_line_of("ends"),
            "{\"time\":\"2023-11-14T22:13:20.042Z\",\"level\":\"warning\",\"message\":\"ends\"}\n");
}

TEST(LogFormat, WhatIsNoTextOrNoJsonIsEscapedInBothForms) {
  EXPECT_THAT(json_line_of("a \"b\" \\ \n"), HasSubstr(R"("message":"a \"b\" \\ \u000a")"));
  const std::string sound = "12 \xc2\xb5m, \xe2\x82\xac, \xf0\x9f\x98\x80";
  EXPECT_THAT(json_line_of(sound), HasSubstr("\"message\":\"" + sound + "\""));
  // A stray byte, one cut off, one longer than it need be, a surrogate, beyond the last character, and a terminal's
  // command.
  const std::string unsound = "a\xff \xe2\x82 \xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xc2\x9b";
  EXPECT_THAT(json_line_of(unsound),
              HasSubstr(R"(a\\xff \\xe2\\x82 \\xc0\\xaf \\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80 \\xc2\\x9b)"));
  EXPECT_EQ(printable("a\u202eb\u2066\u061c\u200f \u202f \u05d0"),
            "a\\xe2\\x80\\xaeb\\xe2\\x81\\xa6\\xd8\\x9c\\xe2\\x80\\x8f \u202f \u05d0")
      << "Hebrew is text, what turns the text beside it is not.";
  spdlog::memory_buf_t line;
  make_text_formatter()->format({"name", spdlog::level::warn, unsound}, line);
  EXPECT_THAT(std::string(line.data(), line.size()),
              HasSubstr(R"(a\xff \xe2\x82 \xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xc2\x9b)"));
}

TEST(ChangeLog, TellsWhatByWhomAndForWhichRequestWithAKeyEach) {
  const LogCapture log(make_json_formatter());
  AuditLog audit("");
  rpc::log_change(audit, "jobs/12", "created", "anna", "night \"3\"\n[2030-01-01] [info] jobs/9 deleted by root\\");
  rpc::log_change(audit, "sweeps/7", "created with 1000 jobs", "bob");
  rpc::log_change(audit, "", "drained", "chief");
  spdlog::info("ends");
  EXPECT_EQ(log.count_lines(""), 4) << "A request id forges no line.";
  const std::string text = log.text();
  EXPECT_THAT(text, HasSubstr("\"level\":\"info\",\"job\":\"jobs/12\",\"caller\":\"anna\",\"request\":\"night "
                              "\\\"3\\\"\\u000a[2030-01-01] [info] jobs/9 deleted by root\\\\\","
                              "\"message\":\"jobs/12 created by anna, "));
  EXPECT_THAT(text, HasSubstr("\"level\":\"info\",\"sweep\":\"sweeps/7\",\"caller\":\"bob\","
                              "\"message\":\"sweeps/7 created with 1000 jobs by bob\"}\n"));
  EXPECT_THAT(text,
              HasSubstr("\"level\":\"info\",\"caller\":\"chief\",\"message\":\"the daemon drained by chief\"}\n"));
  EXPECT_THAT(text, EndsWith("\"level\":\"info\",\"message\":\"ends\"}\n")) << "It has no fields of the line before.";
}

class LibraryLog : public ::testing::Test {
 protected:
  void SetUp() override {
    gpr_log_verbosity_init();  // as grpc_init does
    redirect_library_logs();
  }

  LogCapture log_{make_text_formatter()};
};

TEST_F(LibraryLog, LinesOfGrpcAndProtobufAreThoseOfTheDaemon) {
  gpr_log(GPR_ERROR, "value=%s", "x\n[2030-01-01] [info] jobs/9 deleted by root\xff");
  EXPECT_EQ(log_.count_lines("[error] gRPC: value=x\\x0a[2030-01-01] [info] jobs/9 deleted by root\\xff"), 1)
      << log_.text();
  v1::GetJobRequest request;
  EXPECT_FALSE(request.ParseFromString("\x0a\x01\xff"));
  EXPECT_EQ(log_.count_lines("[error] protobuf: String field 'cellcrush.v1.GetJobRequest.name' contains invalid"), 1)
      << log_.text();
}

TEST_F(LibraryLog, AFloodIsLimitedAndALongLineCut) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 5000; ++i) gpr_log(GPR_ERROR, "%s", std::string(2000, 'x').c_str());
  const auto seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GE(log_.count_lines("gRPC: "), 1);
  EXPECT_LE(log_.count_lines("gRPC: "), 10 * (2 + static_cast<int>(seconds)));
  EXPECT_THAT(log_.text(), Not(HasSubstr(std::string(501, 'x'))));
}

}  // namespace
}  // namespace cellcrush::testing
