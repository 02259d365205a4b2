#include "slurm/kept_daemon.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace cellcrush::testing {

KeptDaemon start_daemon(const std::filesystem::path& log, const std::vector<std::string>& command) {
  std::vector<std::string> words = {DAEMON_KEEPER_PROGRAM, log.string()};
  words.insert(words.end(), command.begin(), command.end());
  return std::make_unique<e2e::Process>(words);
}

void stop_daemon(KeptDaemon& daemon) {
  if (!daemon) return;
  daemon->send(SIGTERM);
  (void)daemon->wait(std::chrono::seconds(20));
  daemon.reset();
}

ReservedPort::ReservedPort() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const int yes = 1;
  setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (bind(socket_, generic, size) != 0 || getsockname(socket_, generic, &size) != 0) {
    close(socket_);
    throw std::runtime_error("no free port on 127.0.0.1");
  }
  number_ = ntohs(address.sin_port);
}

ReservedPort::~ReservedPort() { close(socket_); }

}  // namespace cellcrush::testing
