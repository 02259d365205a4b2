#include "server/daemon_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>

#include "access/token_file.h"
#include "server/certificates.h"
#include "server/temporary_folder.h"

namespace cellcrush::testing {
namespace {

TEST(DaemonProcess, ATestThatIsAbortedLeavesNoDaemonBehind) {
  const TemporaryFolder folder;
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t test = fork();
  ASSERT_GE(test, 0);
  if (test == 0) {
    DaemonProcess daemon(
        {"--data", (folder.path() / "data").string(), "--listen", "unix:" + (folder.path() / "socket").string()});
    const pid_t number = daemon.wait_for_addresses(1).empty() ? 0 : daemon.number();
    _exit(write(ends[1], &number, sizeof number) == sizeof number ? 0 : 1);
  }
  close(ends[1]);
  pid_t daemon = 0;
  ASSERT_EQ(read(ends[0], &daemon, sizeof daemon), static_cast<ssize_t>(sizeof daemon));
  close(ends[0]);
  ASSERT_EQ(waitpid(test, nullptr, 0), test);
  ASSERT_GT(daemon, 0);
  EXPECT_TRUE(wait_until_gone(daemon, std::chrono::seconds(5)));
  kill(daemon, SIGKILL);
}

TEST(DaemonProcess, AHangupReadsTheTokensAgainAndNeverEndsTheDaemon) {
  const TemporaryFolder folder;
  const auto made = access::make_token("anna", access::Scope::read);
  write_secret(folder.path() / "tokens", made.line + "\n");
  for (const bool has_tokens : {true, false}) {
    std::vector<std::string> arguments = {"--data", (folder.path() / "data").string(), "--listen",
                                          "unix:" + (folder.path() / "socket").string()};
    if (has_tokens) arguments.insert(arguments.end(), {"--tokens", (folder.path() / "tokens").string()});
    DaemonProcess daemon(arguments);
    ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
    daemon.send_signal(SIGHUP);
    EXPECT_TRUE(daemon.wait_for_error(has_tokens ? "tokens reloaded: 1 of --tokens" : "nothing to reload"));
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  }
}

TEST(DaemonProcess, AKeyOfTheConfigFileThatIsNoOptionIsRefusedWithTheNearest) {
  const TemporaryFolder folder;
  const auto start_with = [&](const std::string& text) {
    write_secret(folder.path() / "config.toml", text);
    DaemonProcess daemon({"--data", (folder.path() / "data").string(), "--listen",
                          "unix:" + (folder.path() / "socket").string(), "--config",
                          (folder.path() / "config.toml").string()});
    const bool serves = daemon.wait_for_addresses(1).size() == 1;
    if (serves) daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), serves ? 0 : 2);
    return serves ? "" : daemon.errors();
  };
  EXPECT_EQ(start_with("workers = 1\nmin-free-disk = 0\n"), "");
  EXPECT_NE(start_with("min-fre-disk = 0\n").find("Did you mean \"min-free-disk\"?"), std::string::npos);
  EXPECT_NE(start_with("colour = \"red\"\n").find("\"colour\", which is not an option"), std::string::npos);
}

TEST(DaemonProcess, AnUnknownOptionIsRefusedWithTheNearest) {
  const auto errors_of = [](const std::vector<std::string>& arguments) {
    DaemonProcess daemon(arguments);
    EXPECT_EQ(daemon.wait(), 2);
    return daemon.errors();
  };
  EXPECT_EQ(errors_of({"--wokers", "3"}),
            "cellcrushd: unknown option \"--wokers\"; did you mean \"--workers\"?\nSee `cellcrushd --help`.\n");
  EXPECT_EQ(errors_of({"token", "anna", "--scope", "read", "--scopes=admin"}),
            "cellcrushd: unknown option \"--scopes\"; did you mean \"--scope\"?\nSee `cellcrushd token --help`.\n");
  EXPECT_EQ(errors_of({"--colour=red"}), "cellcrushd: unknown option \"--colour\"\nSee `cellcrushd --help`.\n");
}

}  // namespace
}  // namespace cellcrush::testing
