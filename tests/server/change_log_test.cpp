#include "rpc/request_fields.h"

#include <gmock/gmock.h>
#include <spdlog/spdlog.h>

#include "log_format.h"
#include "server/log_capture.h"

namespace cellcrush::testing {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr const char* kForger = "night \"3\"\n[2030-01-01] [info] jobs/9 deleted by root\\";

TEST(ChangeLog, TellsWhatByWhomAndForWhichRequestWithAKeyEach) {
  const LogCapture log(make_json_formatter());
  rpc::log_change("jobs/12", "created", "anna", "night 3");
  rpc::log_change("sweeps/7", "created with 1000 jobs", "bob");
  rpc::log_change("", "drained", "chief");
  spdlog::info("ends");
  const std::string text = log.text();
  EXPECT_THAT(text, HasSubstr("\"level\":\"info\",\"job\":\"jobs/12\",\"caller\":\"anna\",\"request\":\"night 3\","
                              "\"message\":\"jobs/12 created by anna, request \\\"night 3\\\"\"}\n"));
  EXPECT_THAT(text, HasSubstr("\"level\":\"info\",\"sweep\":\"sweeps/7\",\"caller\":\"bob\","
                              "\"message\":\"sweeps/7 created with 1000 jobs by bob\"}\n"));
  EXPECT_THAT(text,
              HasSubstr("\"level\":\"info\",\"caller\":\"chief\",\"message\":\"the daemon drained by chief\"}\n"));
  EXPECT_THAT(text, EndsWith("\"level\":\"info\",\"message\":\"ends\"}\n")) << "It has no fields of the line before.";
}

TEST(ChangeLog, ARequestIdForgesNoLineAndNoField) {
  {
    const LogCapture log(make_text_formatter());
    rpc::log_change("jobs/12", "created", "anna", kForger);
    EXPECT_THAT(log.text(),
                EndsWith("[info] jobs/12 created by anna, request \"night \\\"3\\\"\\x0a[2030-01-01] [info] "
                         "jobs/9 deleted by root\\\\\"\n"));
    EXPECT_EQ(log.count_lines(""), 1);
  }
  const LogCapture log(make_json_formatter());
  rpc::log_change("jobs/12", "created", "anna", kForger);
  EXPECT_EQ(log.count_lines(""), 1);
  EXPECT_THAT(log.text(), HasSubstr("\"request\":\"night \\\"3\\\"\\u000a[2030-01-01] [info] jobs/9 deleted by "
                                    "root\\\\\",\"message\":\"jobs/12 created by anna, "));
}

}  // namespace
}  // namespace cellcrush::testing
