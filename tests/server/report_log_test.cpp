#include "store/report_log.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "error.h"
#include "programs/temporary_folder.h"
#include "store/sample_reader.h"

namespace cellcrush::store {
namespace {

using Read = ReportLogReader::Read;

class ReportLogTest : public ::testing::Test {
 protected:
  static worker::Report frame_report(int index, int floats = 100) {
    worker::Report report;
    report.mutable_frame()->set_index(index);
    report.mutable_frame()->mutable_position_mm()->Resize(floats, 1.0F);
    return report;
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "reports"; }

  [[nodiscard]] std::string bytes() const { return testing::text_of_file(path()); }

  void write_bytes(const std::string& text) const { std::ofstream(path(), std::ios::binary) << text; }

  testing::TemporaryFolder folder_;
};

TEST_F(ReportLogTest, ReportsComeWholeAndInOrderWhileTheyAreWritten) {
  constexpr int kCount = 300;
  ReportLog log(path());
  std::thread writer([&log] {
    for (int i = 0; i < kCount; ++i) log.append(frame_report(i, 20'000));
  });
  ReportLogReader reader(path());
  worker::Report report;
  for (int next = 0; next < kCount;) {
    const Read read = reader.read(report);
    ASSERT_NE(read, Read::broken);
    if (read == Read::message) {
      ASSERT_EQ(report.frame().index(), next++);
    }
  }
  EXPECT_EQ(reader.read(report), Read::end);
  writer.join();
}

TEST_F(ReportLogTest, ALengthThatWasDamagedTakesNoMemory) {
  const auto most_memory = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // KiB
  };
  write_bytes(std::string("\0\0\0\x3F", 4) + std::string(100, 'x'));
  const auto before = most_memory();
  ReportLogReader reader(path());
  worker::Report report;
  EXPECT_EQ(reader.read(report), Read::end);
  EXPECT_LT(most_memory() - before, 100 * 1024);
}

TEST_F(ReportLogTest, WhatAKilledWriterLeftHalfWrittenIsCutOffWhereverItWasKilled) {
  ReportLog(path()).append(frame_report(0));
  const std::string first = bytes();
  ReportLog(path()).append(frame_report(1));
  const std::string both = bytes();
  for (std::size_t size = first.size(); size < both.size(); size += 7) {
    write_bytes(both.substr(0, size));
    ReportLogReader reader(path());
    worker::Report report;
    ASSERT_EQ(reader.read(report), Read::message);
    ASSERT_EQ(reader.read(report), Read::end) << size;
    // The reader has seen the half, and goes on behind what is written in its place.
    ReportLog(path()).append(frame_report(2, 50));
    ASSERT_EQ(reader.read(report), Read::message) << size;
    EXPECT_EQ(report.frame().index(), 2);
  }
}

TEST_F(ReportLogTest, AFlippedBitIsBroken) {
  {
    ReportLog log(path());
    log.append(frame_report(0));
    log.append(frame_report(1));
  }
  const std::string whole = bytes();
  for (std::size_t at = 4; at < whole.size() / 2; at += 11) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    write_bytes(flipped);
    worker::Report report;
    EXPECT_EQ(ReportLogReader(path()).read(report), Read::broken) << at;
  }
}

TEST_F(ReportLogTest, SamplesThatWereCutOffAndReportedAnewAreReadFromTheStart) {
  const std::filesystem::path log = folder_.path() / "jobs/1/reports";
  std::filesystem::create_directories(log.parent_path());
  const auto report_samples = [&](bool with_frames) {
    std::filesystem::remove(log);
    for (int step = 1; step <= 4; ++step) {
      worker::Report report;
      report.mutable_sample()->set_step(step);
      ReportLog(log).append(report);
      if (with_frames) ReportLog(log).append(frame_report(step));
    }
  };
  SampleReader reader(folder_.path());
  report_samples(true);
  ASSERT_EQ(reader.read({1, 0, 0, 2}, {}).samples.size(), 2U);
  report_samples(false);
  const auto found = reader.read({1, 0, 2, 2}, {});
  ASSERT_EQ(found.samples.size(), 2U);
  EXPECT_EQ(found.samples.back().step(), 4);
}

TEST_F(ReportLogTest, AnAbsentLogIsAnErrorThatNamesIt) {
  EXPECT_THROW(ReportLogReader(folder_.path() / "absent"), ServiceError);
}

}  // namespace
}  // namespace cellcrush::store
