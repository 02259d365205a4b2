#include "worker/report_stream.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "worker/report.pb.h"

namespace cellcrush::worker {
namespace {

class ReportStreamTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends_.data()), 0); }
  void TearDown() override {
    for (const int end : ends_) close(end);
  }
  void close_writer() {
    close(ends_[0]);
    ends_[0] = -1;
  }

  std::array<int, 2> ends_{};
};

TEST_F(ReportStreamTest, MessagesComeWholeAndInOrder) {
  std::thread writer([this] {
    ReportStream stream(ends_[0]);
    for (int i = 0; i < 100; ++i) {
      Report report;
      report.mutable_frame()->set_index(i);
      report.mutable_frame()->mutable_position_mm()->Resize(10'000, 1.0F);
      stream.write(report);
    }
    close_writer();
  });
  ReportStream stream(ends_[1]);
  Report report;
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(stream.read(report), ReportStream::Read::message);
    EXPECT_EQ(report.frame().index(), i);
  }
  EXPECT_EQ(stream.read(report), ReportStream::Read::end);
  writer.join();
}

TEST_F(ReportStreamTest, AnEndInTheMiddleOfAMessageIsAnEnd) {
  const std::array<char, 6> cut = {100, 0, 0, 0, 1, 2};
  ASSERT_EQ(write(ends_[0], cut.data(), cut.size()), 6);
  close_writer();
  Report report;
  EXPECT_EQ(ReportStream(ends_[1]).read(report), ReportStream::Read::end);
}

TEST_F(ReportStreamTest, NonsenseIsBroken) {
  const std::array<char, 7> nonsense = {3, 0, 0, 0, '\xff', '\xff', '\xff'};
  ASSERT_EQ(write(ends_[0], nonsense.data(), nonsense.size()), 7);
  Report report;
  EXPECT_EQ(ReportStream(ends_[1]).read(report), ReportStream::Read::broken);
  const std::array<unsigned char, 4> too_long = {0xff, 0xff, 0xff, 0xff};
  ASSERT_EQ(write(ends_[0], too_long.data(), too_long.size()), 4);
  EXPECT_EQ(ReportStream(ends_[1]).read(report), ReportStream::Read::broken);
}

TEST_F(ReportStreamTest, WritingToNobodyIsToldAndIsNoSignal) {
  close(ends_[1]);
  ends_[1] = -1;
  EXPECT_FALSE(ReportStream(ends_[0]).write(Report()));
}

}  // namespace
}  // namespace cellcrush::worker
