// cellcrushd as a process: its addresses, its options and its signals.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "access/token_file.h"
#include "server/certificates.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class DaemonTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string data() const { return (folder_.path() / "data").string(); }
  [[nodiscard]] std::string socket() const { return "unix:" + (folder_.path() / "socket").string(); }

  TemporaryFolder folder_;
};

TEST_F(DaemonTest, ServesASocketAndAPortAtOnceAndEndsInOrder) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--listen", "127.0.0.1:0"});
  const auto addresses = daemon.wait_for_addresses(2);
  ASSERT_EQ(addresses.size(), 2U);
  EXPECT_EQ(addresses[0], socket());
  EXPECT_THAT(addresses[1], StartsWith("127.0.0.1:"));
  EXPECT_NE(addresses[1], "127.0.0.1:0");
  const std::string job = Client(addresses[0]).create(small_case());
  EXPECT_TRUE(Client(addresses[1]).watch(job).status.ok());
  struct stat status {};
  ASSERT_EQ(stat(socket().substr(5).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  ASSERT_EQ(stat(data().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
  daemon.send_signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
}

TEST_F(DaemonTest, EndsInOrderWhileAJobIsWatched) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--workers", "1"});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  Client client(socket());
  const std::string job = client.create(endless_case());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  const std::string waiting = client.create(small_case());
  const auto context = bounded_context();
  const auto reader = client.jobs->WatchJob(context.get(), named<v1::WatchJobRequest>(waiting));
  v1::JobEvent event;
  ASSERT_TRUE(reader->Read(&event));
  daemon.send_signal(SIGINT);
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  while (reader->Read(&event)) {
  }
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
}

TEST_F(DaemonTest, ASecondDaemonOnTheSameFolderIsRefused) {
  DaemonProcess daemon({"--data", data(), "--listen", socket()});
  ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
  DaemonProcess second({"--data", data(), "--listen", "127.0.0.1:0"});
  EXPECT_TRUE(second.wait_for_addresses(1).empty());
  EXPECT_EQ(second.wait(), 1);
  EXPECT_THAT(second.errors(), HasSubstr("is in use by a running daemon"));
}

TEST_F(DaemonTest, APortOrASocketInUseIsRefused) {
  DaemonProcess daemon({"--data", data(), "--listen", socket(), "--listen", "127.0.0.1:0"});
  const auto addresses = daemon.wait_for_addresses(2);
  ASSERT_EQ(addresses.size(), 2U);
  for (const auto& address : addresses) {
    DaemonProcess second({"--data", (folder_.path() / "other").string(), "--listen", address});
    EXPECT_TRUE(second.wait_for_addresses(1).empty());
    EXPECT_EQ(second.wait(), 1);
    EXPECT_THAT(second.errors(), HasSubstr("Cannot listen on " + address));
  }
  EXPECT_FALSE(Client(addresses[0]).create(small_case()).empty()) << "The first one goes on.";
}

TEST_F(DaemonTest, ATestThatIsAbortedLeavesNoDaemonBehind) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t test = fork();
  ASSERT_GE(test, 0);
  if (test == 0) {
    DaemonProcess daemon({"--data", data(), "--listen", socket()});
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

TEST_F(DaemonTest, AHangupReadsTheTokensAgainAndNeverEndsTheDaemon) {
  const auto made = access::make_token("anna", access::Scope::read);
  write_secret(folder_.path() / "tokens", made.line + "\n");
  for (const bool has_tokens : {true, false}) {
    std::vector<std::string> arguments = {"--data", data(), "--listen", socket()};
    if (has_tokens) arguments.insert(arguments.end(), {"--tokens", (folder_.path() / "tokens").string()});
    DaemonProcess daemon(arguments);
    ASSERT_EQ(daemon.wait_for_addresses(1).size(), 1U);
    daemon.send_signal(SIGHUP);
    EXPECT_TRUE(daemon.wait_for_error(has_tokens ? "tokens reloaded: 1 of --tokens" : "nothing to reload"));
    daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  }
}

TEST_F(DaemonTest, AKeyOfTheConfigFileThatIsNoOptionIsRefusedWithTheNearest) {
  const auto start_with = [&](const std::string& text) {
    write_secret(folder_.path() / "config.toml", text);
    DaemonProcess daemon(
        {"--data", data(), "--listen", socket(), "--config", (folder_.path() / "config.toml").string()});
    const bool serves = daemon.wait_for_addresses(1).size() == 1;
    if (serves) daemon.send_signal(SIGTERM);
    EXPECT_EQ(daemon.wait(), serves ? 0 : 2);
    return serves ? "" : daemon.errors();
  };
  EXPECT_EQ(start_with("workers = 1\nmin-free-disk = 0\n"), "");
  EXPECT_THAT(start_with("min-fre-disk = 0\n"), HasSubstr("Did you mean \"min-free-disk\"?"));
  EXPECT_THAT(start_with("colour = \"red\"\n"), HasSubstr("\"colour\", which is not an option"));
}

TEST_F(DaemonTest, AnUnknownOptionIsRefusedWithTheNearest) {
  const auto errors_of = [](const std::vector<std::string>& arguments) {
    DaemonProcess daemon(arguments);
    EXPECT_EQ(daemon.wait(), 2);
    return daemon.errors();
  };
  EXPECT_THAT(errors_of({"--wokers", "3"}),
              HasSubstr("cellcrushd: --wokers is not an option. Did you mean \"--workers\"?"));
  EXPECT_THAT(errors_of({"token", "anna", "--scope", "read", "--scopes=admin"}),
              HasSubstr("Did you mean \"--scope\"?"));
  EXPECT_THAT(errors_of({"--colour=red"}), HasSubstr("--colour is not an option.\n`cellcrushd --help`"));
}

}  // namespace
}  // namespace cellcrush::testing
