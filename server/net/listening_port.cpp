#include "net/listening_port.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "error.h"

namespace cellcrush::net {
namespace {

constexpr int kBacklog = 1024;
// A port that is free on IPv4 may be taken on IPv6.
constexpr int kTriesForAFreePort = 10;

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses resolve(std::string host) {
  if (host.front() == '[') host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* list = nullptr;
  return getaddrinfo(host.c_str(), "0", &hints, &list) == 0 ? Addresses(list) : nullptr;
}

int port_of(int socket) {
  sockaddr_storage name{};
  socklen_t size = sizeof(name);
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size) != 0) return 0;
  return ntohs(name.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(name).sin6_port
                                          : reinterpret_cast<const sockaddr_in&>(name).sin_port);
}

void set_port(sockaddr* name, int port) {
  const auto value = htons(static_cast<std::uint16_t>(port));
  if (name->sa_family == AF_INET6)
    reinterpret_cast<sockaddr_in6*>(name)->sin6_port = value;
  else
    reinterpret_cast<sockaddr_in*>(name)->sin_port = value;
}

bool is_wildcard(const sockaddr* name) {
  return name->sa_family == AF_INET6 &&
         IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6*>(name)->sin6_addr);
}

// A listening socket, or -1 with errno set.
int open_socket(const sockaddr* name, socklen_t size) {
  const int out = socket(name->sa_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (out < 0) return -1;
  const int on = 1;
  const int only_ipv6 = is_wildcard(name) ? 0 : 1;
  if (name->sa_family != AF_UNIX) setsockopt(out, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (name->sa_family == AF_INET6) setsockopt(out, IPPROTO_IPV6, IPV6_V6ONLY, &only_ipv6, sizeof(only_ipv6));
  // The file of the socket never has a wider mode than wanted, whatever the umask.
  if (name->sa_family == AF_UNIX) fchmod(out, 0600);
  if (bind(out, name, size) == 0 && listen(out, kBacklog) == 0) return out;
  const int reason = errno;
  close(out);
  errno = reason;
  return -1;
}

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

// A descriptor of its own for the listening socket at the path that systemd has opened for this process, and keeps
// (sd_listen_fds(3)); -1 without one, or with errno set.
int inherited_socket(const std::string& path) {
  constexpr int kFirst = 3;
  if (number_of("LISTEN_PID") != getpid()) return -1;
  const long end = kFirst + number_of("LISTEN_FDS");
  int out = -1;
  for (int descriptor = kFirst; descriptor < end; ++descriptor) {
    fcntl(descriptor, F_SETFD, FD_CLOEXEC);  // it is not for workers
    if (out >= 0 || !listens_at(descriptor, path)) continue;
    fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
    out = fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  }
  return out;
}

ino_t inode_of(const std::string& path) {
  struct stat status {};
  return lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

[[noreturn]] void refuse(const ListenAddress& address, const char* option) {
  const bool in_use = errno == EADDRINUSE;
  throw ServiceError(
      ServiceError::Kind::failed_precondition,
      "Cannot listen on " + address.text() + ": " +
          (in_use ? "another program is listening there. Stop it," : std::strerror(errno) + std::string(".")) +
          (in_use ? " or give" : " Give") + " another address with " + option + ".");
}

}  // namespace

ListeningPort::ListeningPort(const ListenAddress& wanted, const char* option, mode_t mode)
    : address_(wanted), option_(option), mode_(mode) {
  reopen();
}

ListeningPort::~ListeningPort() { close_all(); }

ListeningPort::ListeningPort(ListeningPort&& other) noexcept
    : address_(std::move(other.address_)),
      option_(other.option_),
      mode_(other.mode_),
      descriptors_(std::exchange(other.descriptors_, {})),
      file_(std::exchange(other.file_, 0)) {}

void ListeningPort::reopen() {
  close_all();
  address_.kind == ListenAddress::Kind::unix_socket ? listen_on_unix_socket() : listen_on_tcp();
}

void ListeningPort::listen_on_unix_socket() {
  if (const int inherited = inherited_socket(address_.place); inherited >= 0) {
    descriptors_.push_back(inherited);
    return;
  }
  remove_stale_socket(address_.place);
  const SocketName name = name_of(address_);
  const int socket = open_socket(reinterpret_cast<const sockaddr*>(&name.address), name.size);
  if (socket < 0) refuse(address_, option_);
  descriptors_.push_back(socket);
  file_ = inode_of(address_.place);
  if (chmod(address_.place.c_str(), mode_) != 0) refuse(address_, option_);
}

void ListeningPort::listen_on_tcp() {
  // All addresses of both families: one IPv6 socket serves both, if the machine has IPv6.
  if (address_.place == "0.0.0.0") listen_on("::");
  if (descriptors_.empty()) listen_on(address_.place);
  if (descriptors_.empty()) refuse(address_, option_);
}

void ListeningPort::listen_on(const std::string& host) {
  const Addresses addresses = resolve(host);
  errno = EADDRNOTAVAIL;
  for (int i = 0; i < kTriesForAFreePort && descriptors_.empty(); ++i) {
    int port = address_.port;
    for (const addrinfo* next = addresses.get(); next != nullptr; next = next->ai_next) {
      set_port(next->ai_addr, port);
      const int socket = open_socket(next->ai_addr, next->ai_addrlen);
      // A machine may lack a family of the name; a port in use by another program is an error.
      if (socket < 0 && errno != EADDRINUSE) continue;
      if (socket < 0) {
        close_all();
        break;
      }
      descriptors_.push_back(socket);
      port = port_of(socket);
    }
    if (!descriptors_.empty()) address_.port = port;
    if (address_.port != 0) break;
  }
}

void ListeningPort::close_all() {
  const int reason = errno;
  for (const int socket : descriptors_) close(socket);
  descriptors_.clear();
  // Another daemon may have taken the path meanwhile.
  if (file_ != 0 && inode_of(address_.place) == file_) unlink(address_.place.c_str());
  file_ = 0;
  errno = reason;
}

void remove_stale_socket(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return;
  const std::string name = "unix:" + path;
  if (!S_ISSOCK(status.st_mode)) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "Cannot listen on " + name + ": the path exists and is not a socket. Use another path.");
  }
  const SocketName address = name_of({ListenAddress::Kind::unix_socket, path, 0});
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool answers = connect(probe, reinterpret_cast<const sockaddr*>(&address.address), address.size) == 0;
  close(probe);
  if (answers) {
    throw ServiceError(
        ServiceError::Kind::failed_precondition,
        "Cannot listen on " + name + ": another program is listening there. Stop it, or use another path.");
  }
  unlink(path.c_str());
}

SocketName name_of(const ListenAddress& address) {
  SocketName out;
  if (address.kind == ListenAddress::Kind::unix_socket) {
    auto& name = reinterpret_cast<sockaddr_un&>(out.address);
    name.sun_family = AF_UNIX;
    std::strncpy(name.sun_path, address.place.c_str(), sizeof(name.sun_path) - 1);
    out.size = sizeof(name);
    return out;
  }
  const std::string host = address.place == "0.0.0.0" ? "127.0.0.1" : address.place == "[::]" ? "::1" : address.place;
  if (const Addresses list = resolve(host)) {
    set_port(list->ai_addr, address.port);
    std::memcpy(&out.address, list->ai_addr, list->ai_addrlen);
    out.size = list->ai_addrlen;
  }
  return out;
}

}  // namespace cellcrush::net
