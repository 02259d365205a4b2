// The log when nobody reads it, and when its file is moved away.
#include "log_writer.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <spdlog/logger.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>

#include "error.h"
#include "open_file.h"
#include "programs/process.h"
#include "programs/temporary_folder.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class LogWriterTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  // The log as a pipe that has a reader, who reads when the test says so.
  OpenFile make_pipe() {
    EXPECT_EQ(mkfifo(path("log").c_str(), 0600), 0);
    return OpenFile(open(path("log").c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  }

  // Such a pipe that takes no more.
  OpenFile make_full_pipe() {
    OpenFile pipe = make_pipe();
    const std::string junk(65536, 'x');
    while (write(pipe.get(), junk.data(), junk.size()) > 0) {
    }
    return pipe;
  }

  // Reads what comes until the words have.
  static std::string read_until(const OpenFile& pipe, const std::string& words) {
    std::string out;
    const auto read_more = [&] {
      std::string piece(65536, '\0');
      for (ssize_t count = 0; (count = read(pipe.get(), piece.data(), piece.size())) > 0;)
        out.append(piece, 0, static_cast<std::size_t>(count));
      return out.find(words) != std::string::npos;
    };
    EXPECT_TRUE(wait_until(read_more)) << out.substr(0, 1000);
    return out;
  }

  TemporaryFolder folder_;
};

TEST_F(LogWriterTest, LinesThatNobodyReadsAreLostAndCounted) {
  const OpenFile pipe = make_pipe();
  const std::int64_t before = LogWriter::lost_lines();
  constexpr int kLines = 20'000;
  const auto writer = std::make_shared<LogWriter>(path("log"));
  spdlog::logger log("log", writer);
  for (int i = 0; i < kLines; ++i) log.info("line {} {}", i, std::string(100, '.'));
  const auto lost = LogWriter::lost_lines() - before;
  EXPECT_GT(lost, 1'000);
  const std::string text = read_until(pipe, "or could not be written\n");
  EXPECT_THAT(text, HasSubstr("] [warning] " + std::to_string(lost) + " lines of the log are lost: "));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), kLines - lost + 1) << "Every other line is there.";
  log.info("read again");
  EXPECT_THAT(read_until(pipe, "read again\n"), Not(HasSubstr("lost")));
}

TEST_F(LogWriterTest, AStoppedReaderHoldsNeitherJobsNorCallsNorTheEnd) {
  const OpenFile pipe = make_full_pipe();
  DaemonProcess daemon({"--data", path("data"), "--listen", "unix:" + path("s").string(), "--log-file", path("log")});
  Client client(daemon.wait_for_addresses(1).at(0));
  std::string job;
  for (int i = 0; i < 3; ++i) job = client.create(small_case(), v1::Job::SUCCEEDED);
  EXPECT_TRUE(client.remove(job).ok());
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
}

TEST_F(LogWriterTest, AddressesThatNobodyReadsHoldUpNeitherJobsNorTheEnd) {
  const OpenFile pipe = make_full_pipe();
  const std::string socket = path("s").string();
  e2e::Process daemon({"/bin/sh", "-c", "exec \"$0\" \"$@\" >'" + path("log").string() + "'", CELLCRUSHD_PROGRAM,
                       "--data", path("data"), "--http", "none", "--listen", "unix:" + socket});
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(socket); }));
  Client("unix:" + socket).create(small_case(), v1::Job::SUCCEEDED);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(std::chrono::seconds(20)).exit_code, 0);
}

TEST_F(LogWriterTest, AFileThatWasMovedAwayIsOpenedAgain) {
  DaemonProcess daemon({"--data", path("data"), "--listen", "unix:" + path("s").string(), "--log-file", path("log")});
  Client client(daemon.wait_for_addresses(1).at(0));
  client.create(small_case(), v1::Job::SUCCEEDED);
  EXPECT_TRUE(wait_until([&] { return text_of_file(path("log")).find("jobs/1 SUCCEEDED") != std::string::npos; }));
  std::filesystem::rename(path("log"), path("log.1"));
  daemon.send_signal(SIGHUP);
  EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(path("log")); }));
  client.create(small_case(), v1::Job::SUCCEEDED);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_THAT(text_of_file(path("log.1")), HasSubstr("jobs/1 SUCCEEDED"));
  const std::string text = text_of_file(path("log"));
  EXPECT_THAT(text, HasSubstr("jobs/2 SUCCEEDED"));
  EXPECT_THAT(text, HasSubstr("[info] stopping on SIGTERM")) << "Nothing that was said before the end is lost.";
  EXPECT_THAT(text, Not(HasSubstr("jobs/1 SUCCEEDED")));
  struct stat status {};
  ASSERT_EQ(stat(path("log").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(LogWriterTest, AFileThatCannotBeOpenedEndsTheDaemonBeforeItServes) {
  DaemonProcess daemon({"--data", path("data"), "--log-file", path("none/log")});
  EXPECT_EQ(daemon.wait(), 1);
  EXPECT_THAT(daemon.errors(), HasSubstr("--log-file: " + path("none/log").string() + " cannot be opened: No such"));
}

}  // namespace
}  // namespace cellcrush::testing
