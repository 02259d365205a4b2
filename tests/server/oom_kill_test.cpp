// A worker process that ends by SIGKILL while the kernel's count of such kills rises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "jobs/local_process.h"
#include "jobs/outcome.h"
#include "server/temporary_folder.h"

namespace cellcrush::jobs {
namespace {

class OomKillTest : public ::testing::Test {
 protected:
  OomKillTest() {
    std::filesystem::create_directory(job_.root());
    std::ofstream(program()) << "#!/bin/sh\nkill -9 $$\n";
    EXPECT_EQ(chmod(program().c_str(), 0700), 0);
  }

  [[nodiscard]] std::filesystem::path program() const { return folder_.path() / "worker"; }

  // How a worker that is killed ends when the kernel has killed so many processes before it starts and when it has
  // ended.
  WorkerExit run(std::uint64_t before, std::uint64_t after) const {
    LocalProcess executor(program(), std::chrono::seconds(20), [before, after, asked = false]() mutable {
      return std::exchange(asked, true) ? after : before;
    });
    WorkerEvents events;
    events.started = [](int) {};
    events.reported = [](worker::Report&) {};
    events.watched = [] { return false; };
    return executor.run(job_, worker::Order(), events, {});
  }

  testing::TemporaryFolder folder_;
  store::JobFolder job_{folder_.path() / "1"};
};

TEST_F(OomKillTest, AKillThatTheKernelCountedIsOutOfMemory) {
  const auto exit = run(7, 8);
  EXPECT_EQ(exit.kind, WorkerExit::Kind::signalled);
  EXPECT_TRUE(exit.out_of_memory);
  EXPECT_TRUE(is_lost(exit));
  EXPECT_EQ(outcome_of(exit).cause, v1::Job::OUT_OF_MEMORY);
  EXPECT_NE(outcome_of(exit).remedy.find("--workers"), std::string::npos);
}

TEST_F(OomKillTest, AnyOtherKillIsNot) {
  const auto exit = run(7, 7);
  EXPECT_FALSE(exit.out_of_memory);
  EXPECT_EQ(outcome_of(exit).cause, v1::Job::WORKER_CRASHED);
}

TEST_F(OomKillTest, TheCountOfThisMachineCanBeRead) { EXPECT_LE(count_oom_kills(), count_oom_kills()); }

}  // namespace
}  // namespace cellcrush::jobs
