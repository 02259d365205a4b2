#include "net/inherited_sockets.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "error.h"

namespace cellcrush::net {
namespace {

constexpr int kFirst = 3;  // of the descriptors that systemd passes

// 0 where the variable is no number.
long number_of(const char* variable) {
  const char* value = std::getenv(variable);
  long out = 0;
  if (value != nullptr) std::from_chars(value, value + std::strlen(value), out);
  return out;
}

bool listens_at(int descriptor, std::string_view path) {
  sockaddr_un name{};
  socklen_t size = sizeof(name);
  int listens = 0;
  socklen_t length = sizeof(listens);
  return getsockname(descriptor, reinterpret_cast<sockaddr*>(&name), &size) == 0 && name.sun_family == AF_UNIX &&
         path == name.sun_path && getsockopt(descriptor, SOL_SOCKET, SO_ACCEPTCONN, &listens, &length) == 0 &&
         listens != 0;
}

}  // namespace

int inherited_unix_socket(const std::string& path) {
  if (number_of("LISTEN_PID") != getpid()) return -1;
  const long end = kFirst + number_of("LISTEN_FDS");
  for (int descriptor = kFirst; descriptor < end; ++descriptor) {
    if (!listens_at(descriptor, path)) continue;
    fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
    const int own = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (own >= 0) return own;
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "Cannot take the socket unix:" + path + " of systemd: " + std::strerror(errno) + ".");
  }
  return -1;
}

}  // namespace cellcrush::net
