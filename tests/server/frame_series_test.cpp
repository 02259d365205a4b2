#include "jobs/frame_series.h"

#include <gtest/gtest.h>

#include "server/temporary_folder.h"
#include "store/report_log.h"

namespace cellcrush::jobs {
namespace {

TEST(FrameSeries, FramesOfReportsAreReadInAnyOrder) {
  const testing::TemporaryFolder folder;
  const store::JobFolder job(folder.path());
  {
    store::ReportLog log(job.reports());
    for (int i = 0; i < 5; ++i) {
      worker::Report report;
      report.mutable_frame()->set_index(i);
      report.mutable_frame()->set_time_s(0.5 * i);
      log.append(report);
    }
  }
  const auto series = open_frame_series(job);
  ASSERT_NE(series, nullptr);
  EXPECT_EQ(series->times().time_s_size(), 5);
  for (const int index : {1, 3, 3, 0, 4, 2}) EXPECT_EQ(series->frame(index).time_s(), 0.5 * index);
}

}  // namespace
}  // namespace cellcrush::jobs
