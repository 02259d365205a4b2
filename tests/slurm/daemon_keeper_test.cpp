// What a daemon leaves behind ends with its keeper, however that one is ended.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "programs/process.h"
#include "programs/temporary_folder.h"
#include "server/daemon_process.h"
#include "slurm/process_tree.h"

namespace cellcrush::testing {
namespace {

constexpr std::chrono::seconds kKeeperLimit{20};

// A keeper of a daemon that has left a process in a session of its own, as slurmd does.
class DaemonKeeper : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> command() const {
    return {DAEMON_KEEPER_PROGRAM, (folder_.path() / "log").string(), "/bin/sh", "-c",
            "(setsid sleep 1000 &); exec cat /dev/zero >/dev/null"};
  }

  // The sleep that has become a child of the keeper.
  static pid_t find_left_behind(pid_t keeper) {
    pid_t out = 0;
    wait_until([&] {
      for (const pid_t child : children_of(keeper)) {
        if (program_of(child) == "sleep") out = child;
      }
      return out != 0;
    });
    return out;
  }

  TemporaryFolder folder_;
};

// Its parent's death sends it the SIGTERM that stop_daemon sends.
TEST_F(DaemonKeeper, KillsWhatADaemonHasLeftBehindWhenItsParentIsKilled) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    const e2e::Process keeper(command());
    const pid_t found[2] = {keeper.id(), find_left_behind(keeper.id())};
    if (write(pipe_ends[1], found, sizeof(found)) != sizeof(found)) _exit(1);
    pause();
    _exit(1);
  }
  pid_t found[2] = {0, 0};
  ASSERT_EQ(read(pipe_ends[0], found, sizeof(found)), static_cast<ssize_t>(sizeof(found)));
  close(pipe_ends[0]);
  close(pipe_ends[1]);
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  ASSERT_NE(found[1], 0);
  EXPECT_TRUE(wait_until_gone(found[1], kKeeperLimit));
  EXPECT_TRUE(wait_until_gone(found[0], kKeeperLimit));
}

}  // namespace
}  // namespace cellcrush::testing
