// A user without root's rights can set up the daemon of a login node as its page shows.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docs/session.h"
#include "programs/process.h"
#include "programs/temporary_folder.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

TEST(LoginNodePage, EveryCommandDoesWhatThePageShows) {
  // The local disk and the port are the test's own.
  expect_shown("deploy/slurm/login-node.md", Reader::ordinary_user,
               {{"/var/tmp/", "$HOME/disk/"}, {"$((20000 + UID % 10000))", "0"}});
}

TEST(LoginNodePage, SystemdAcceptsTheUnit) {
  const std::string program = "/usr/bin/systemd-analyze";
  if (access(program.c_str(), X_OK) != 0) GTEST_SKIP() << "There is no systemd-analyze; install systemd.";
  const testing::TemporaryFolder home;
  install(home.path() / ".local");
  const std::string unit = (fs::path(CELLCRUSH_SOURCE_ROOT) / "deploy/slurm/cellcrushd.service").string();
  const e2e::Outcome outcome =
      e2e::run({"/usr/bin/env", "HOME=" + home.path().string(), "XDG_RUNTIME_DIR=" + home.path().string(), program,
                "--user", "--man=no", "verify", unit},
               std::chrono::seconds(30));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_EQ(outcome.all(), "") << "An unknown key is only a warning.";
}

}  // namespace
}  // namespace cellcrush::docs
