// A daemon whose Unix socket systemd has opened: it stands before the daemon starts, and after it has ended.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "net/listening_port.h"
#include "open_file.h"
#include "programs/process.h"
#include "programs/temporary_folder.h"
#include "server/daemon_fixture.h"

namespace cellcrush {
namespace {

using testing::Client;
using testing::TemporaryFolder;

/// Opens the socket, then becomes the program with it, as systemd does.
constexpr const char* kManager = R"(
import os, socket, sys
listening = socket.socket(socket.AF_UNIX)
listening.bind(sys.argv[1])
listening.listen()
os.dup2(listening.fileno(), 3)
os.set_inheritable(3, True)
os.environ.update(LISTEN_FDS="1", LISTEN_PID=str(os.getpid()))
os.execv(sys.argv[2], sys.argv[2:])
)";

TEST(InheritedSocket, IsServedAndLeftInItsPlace) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "socket").string();
  e2e::Process daemon({"/usr/bin/python3", "-c", kManager, path, CELLCRUSHD_PROGRAM, "--listen", "unix:" + path,
                       "--http", "none", "--data", (folder.path() / "data").string()});
  ASSERT_TRUE(daemon.wait_for_output("listening on unix:" + path, std::chrono::seconds(30))) << daemon.errors();
  EXPECT_FALSE(Client("unix:" + path).queue().cores().empty());
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(std::chrono::seconds(20)).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_socket(path)) << "it is systemd's";
}

TEST(InheritedSocket, OfAnotherProcessIsNotTaken) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "socket").string();
  setenv("LISTEN_FDS", "1", 1);
  setenv("LISTEN_PID", "1", 1);
  {
    const net::ListeningPort port(parse_listen_address("unix:" + path));
    EXPECT_TRUE(std::filesystem::is_socket(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path)) << "it is this process's own";
  unsetenv("LISTEN_FDS");
  unsetenv("LISTEN_PID");
}

}  // namespace
}  // namespace cellcrush
