// How the files of an attempt in the shared folder come into the job's folder.
#include "slurm/mirror.h"

#include <gmock/gmock.h>

#include <fstream>

#include "error.h"
#include "programs/temporary_folder.h"
#include "slurm/small_file.h"
#include "store/report_log.h"

namespace cellcrush::slurm {
namespace {

namespace fs = std::filesystem;

TEST(ReportLogReader, TakesAHoleForNothing) {
  const testing::TemporaryFolder temporary;
  const fs::path path = temporary.path() / "reports";
  std::ofstream(path, std::ios::binary) << std::string(4096, '\0');
  store::ReportLogReader reader(path);
  std::string records;
  EXPECT_FALSE(reader.read_record(records));
  worker::Report report;
  EXPECT_EQ(reader.read(report), store::ReportLogReader::Read::end);
}

class MirrorTest : public ::testing::Test {
 protected:
  MirrorTest() {
    fs::create_directory(from_.root());
    fs::create_directory(to_.root());
  }

  static std::string content(const fs::path& path) { return read_small_file(path).value_or("(absent)"); }

  static worker::Report progress(int step) {
    worker::Report out;
    out.mutable_progress()->set_step(step);
    return out;
  }

  testing::TemporaryFolder temporary_;
  store::JobFolder from_{temporary_.path() / "from"};
  store::JobFolder to_{temporary_.path() / "to"};
};

TEST_F(MirrorTest, CopiesWholeReportsOnly) {
  Mirror mirror(from_, to_, 0);
  EXPECT_FALSE(mirror.pass());
  store::ReportLog log(from_.reports());
  log.append(progress(1));
  EXPECT_TRUE(mirror.pass());
  const std::string first = content(from_.reports());
  EXPECT_EQ(content(to_.reports()), first);
  log.append(progress(2));
  const std::string both = content(from_.reports());
  fs::resize_file(from_.reports(), both.size() - 1);
  EXPECT_FALSE(mirror.pass());
  EXPECT_EQ(content(to_.reports()), first);
  std::ofstream(from_.reports(), std::ios::binary | std::ios::app) << both.back();
  EXPECT_TRUE(mirror.pass());
  EXPECT_EQ(content(to_.reports()), both);
}

TEST_F(MirrorTest, TakesNoLinkForAResultAndNothingBeyondItsLimit) {
  Mirror mirror(from_, to_, 0, 10'000'000);
  store::ReportLog(from_.reports()).append(progress(1));
  write_small_file(temporary_.path() / "secret", "of another");
  fs::create_symlink(temporary_.path() / "secret", from_.result());
  EXPECT_TRUE(mirror.pass());
  EXPECT_FALSE(fs::exists(to_.result()));
  fs::remove(from_.result());
  for (const auto& path : {from_.result(), from_.checkpoint(), from_.reports()}) {
    const auto text = content(path);
    std::ofstream(path, std::ios::app).close();
    fs::resize_file(path, 20'000'000);
    EXPECT_THROW(mirror.pass(), ServiceError) << path;
    path == from_.reports() ? write_small_file(path, text) : static_cast<void>(fs::remove(path));
  }
  EXPECT_FALSE(mirror.pass());
  EXPECT_FALSE(fs::exists(to_.result()) || fs::exists(to_.checkpoint()));
}

// A run goes on while no daemon follows it.
TEST_F(MirrorTest, TheReportsOfHoursWithoutADaemonHaveRoom) {
  worker::Report large;
  large.mutable_final()->set_message(std::string(2'000'000, 'x'));
  store::ReportLog(from_.reports()).append(large);
  write_small_file(to_.reports(), "");
  EXPECT_THROW(Mirror(from_, to_, 0, 1'000).pass(), ServiceError);
  fs::last_write_time(to_.reports(), fs::file_time_type::clock::now() - std::chrono::hours(2));
  EXPECT_TRUE(Mirror(from_, to_, 0, 1'000).pass());
}

// What cannot be written holds up what has to come after it.
TEST_F(MirrorTest, PutsTheResultBeforeTheReportThatAnnouncesItAndACheckpointAfterItsReports) {
  Mirror mirror(from_, to_, 0);
  store::ReportLog(from_.reports()).append(progress(1));
  write_small_file(from_.checkpoint(), "checkpoint 1");
  write_small_file(from_.result(), "result");
  fs::create_directory(to_.result());
  EXPECT_THROW(mirror.pass(), ServiceError);
  EXPECT_FALSE(fs::exists(to_.reports()));
  fs::remove(to_.result());
  fs::create_directory(to_.reports());
  EXPECT_THROW(mirror.pass(), ServiceError);
  EXPECT_EQ(content(to_.result()), "result");
  EXPECT_FALSE(fs::exists(to_.checkpoint()));
  fs::remove(to_.reports());
  EXPECT_TRUE(mirror.pass());
  EXPECT_EQ(content(to_.reports()), content(from_.reports()));
  EXPECT_EQ(content(to_.checkpoint()), "checkpoint 1");
  EXPECT_FALSE(mirror.pass());
  write_small_file(from_.checkpoint(), "checkpoint 2");
  EXPECT_TRUE(mirror.pass());
  EXPECT_EQ(content(to_.checkpoint()), "checkpoint 2");
  EXPECT_EQ(content(to_.previous_checkpoint()), "checkpoint 1");
}

}  // namespace
}  // namespace cellcrush::slurm
