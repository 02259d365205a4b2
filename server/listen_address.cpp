#include "listen_address.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstring>
#include <filesystem>

#include "error.h"

namespace cellcrush {
namespace {

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw ServiceError(ServiceError::Kind::invalid, "Cannot listen on \"" + std::string(text) + "\": " + why);
}

bool is_loopback(const std::string& host) {
  if (host == "localhost" || host == "[::1]") return true;
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 && (ntohl(address.s_addr) >> 24U) == 127U;
}

ListenAddress parse_unix(std::string_view text, std::string_view path) {
  if (path.empty()) refuse(text, "the path is missing. Use unix:PATH.");
  ListenAddress out{ListenAddress::Kind::unix_socket, std::filesystem::absolute(path).string(), 0};
  const std::size_t limit = sizeof(sockaddr_un::sun_path) - 1;
  if (out.place.size() > limit) {
    refuse(text, "the path of a socket has at most " + std::to_string(limit) + " characters, and this one has " +
                     std::to_string(out.place.size()) + ". Use a shorter one.");
  }
  return out;
}

}  // namespace

std::string ListenAddress::text() const {
  return kind == Kind::unix_socket ? "unix:" + place : place + ":" + std::to_string(port);
}

ListenAddress parse_listen_address(std::string_view text) {
  if (text.starts_with("unix:")) return parse_unix(text, text.substr(5));
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) refuse(text, "use unix:PATH or HOST:PORT.");
  ListenAddress out{ListenAddress::Kind::tcp, std::string(text.substr(0, colon)), 0};
  const std::string_view digits = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out.port);
  if (error != std::errc() || end != digits.data() + digits.size() || out.port < 0 || out.port > 65535)
    refuse(text, "the port is a number from 0 to 65535; 0 takes one that is free.");
  if (!is_loopback(out.place)) {
    refuse(text,
           "the host is not loopback, and calls are not authenticated yet. Use 127.0.0.1, localhost or [::1], and an "
           "SSH tunnel from elsewhere.");
  }
  return out;
}

void remove_stale_socket(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return;
  const std::string name = "unix:" + path;
  if (!S_ISSOCK(status.st_mode)) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "Cannot listen on " + name + ": there is something else than a socket. Use another path.");
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool answers = connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(probe);
  if (answers) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "Cannot listen on " + name + ": another program listens there. Stop it, or use another path.");
  }
  unlink(path.c_str());
}

}  // namespace cellcrush
