#include "limited_log.h"

#include <gtest/gtest.h>

#include "log_format.h"
#include "server/log_capture.h"

namespace cellcrush::testing {
namespace {

TEST(LimitedLog, WritesSoManyLinesASecondAndCountsTheRest) {
  for (const int lines : {1, 3}) {
    const LogCapture log(make_text_formatter());
    LimitedLog::Clock::time_point now;
    {
      LimitedLog refusals("refused calls", lines, [&now] { return now; });
      for (int i = 0; i < 1000; ++i) {
        refusals.write(spdlog::level::warn, "UNAUTHENTICATED: " + std::to_string(i));
        now += std::chrono::milliseconds(10);
      }
      EXPECT_EQ(log.count_lines("[warning] UNAUTHENTICATED"), 10 * lines);
      EXPECT_EQ(log.count_lines("UNAUTHENTICATED: 0"), 1) << "The first is written at once.";
      EXPECT_EQ(log.count_lines("UNAUTHENTICATED: 900 (" + std::to_string(100 - lines) + " more not logged)"), 1)
          << log.text();
    }
    EXPECT_EQ(log.count_lines(std::to_string(100 - lines) + " more refused calls"), 1) << "None is lost at the end.";
  }
}

}  // namespace
}  // namespace cellcrush::testing
