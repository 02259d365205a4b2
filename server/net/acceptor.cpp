#include "net/acceptor.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "error.h"

namespace cellcrush::net {
namespace {

constexpr int kAtOnce = 64;  // connections per socket and turn
constexpr int kLookMilliseconds = 1000;
constexpr int kTurnedAway = 32;  // simultaneous refused connections that receive the reason
constexpr std::chrono::seconds kBetweenCounts{1};
// Without free descriptors, new connections wait in the kernel.
constexpr std::chrono::milliseconds kPause{100};

int open_reserve() { return open("/dev/null", O_RDONLY | O_CLOEXEC); }

bool lacks_descriptors(int error) { return error == EMFILE || error == ENFILE || error == ENOBUFS || error == ENOMEM; }

}  // namespace

Acceptor::Acceptor(std::vector<ListeningPort> ports, const ConnectionLimits& limits, Parts parts)
    : limits_(limits),
      parts_(std::move(parts)),
      ports_(std::move(ports)),
      of_others_({limits.connections, limits.connections_per_address}),
      of_owner_({limits.connections, limits.connections}),
      turned_away_({kTurnedAway, kTurnedAway}),
      reserve_(open_reserve()),
      wake_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (wake_ < 0)
    throw ServiceError(ServiceError::Kind::internal,
                       std::string("Cannot accept connections: ") + std::strerror(errno) + ".");
}

Acceptor::~Acceptor() {
  stop();
  close(wake_);
}

void Acceptor::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void Acceptor::stop() {
  thread_.request_stop();
  wake();
  if (thread_.joinable()) thread_.join();
  const MutexLock lock(mutex_);
  if (std::exchange(closed_, true)) return;
  ports_.clear();
  if (reserve_ >= 0) close(reserve_);
}

std::vector<ListenAddress> Acceptor::addresses() const {
  const MutexLock lock(mutex_);
  std::vector<ListenAddress> out;
  std::transform(ports_.begin(), ports_.end(), std::back_inserter(out),
                 [](const ListeningPort& port) { return port.address(); });
  return out;
}

void Acceptor::reopen(std::size_t port) {
  {
    const MutexLock lock(mutex_);
    if (closed_) return;
    ports_[port].reopen();
  }
  wake();
}

void Acceptor::look_after_connections() {
  if (reserve_ < 0) reserve_ = open_reserve();
  const auto now = std::chrono::steady_clock::now();
  if (now - last_count_ < kBetweenCounts) return;
  last_count_ = now;
  of_others_.drop_closed();
  of_owner_.drop_closed();
  turned_away_.drop_closed();
  parts_.counted(of_others_.count() + of_owner_.count());
}

void Acceptor::wake() const { eventfd_write(wake_, 1); }

void Acceptor::cut(const std::string& name) {
  {
    const MutexLock lock(cuts_mutex_);
    cuts_.push_back(name);
  }
  wake();
}

void Acceptor::cut_connections() {
  std::vector<std::string> cuts;
  {
    const MutexLock lock(cuts_mutex_);
    cuts.swap(cuts_);
  }
  if (cuts.empty()) return;
  const MutexLock lock(mutex_);
  for (const auto& name : cuts) {
    if (of_others_.cut(name)) parts_.refused("further calls of " + name + ", which has too many open");
  }
}

void Acceptor::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) wait_and_accept();
}

void Acceptor::wait_and_accept() {
  cut_connections();
  std::vector<pollfd> waiting = {{wake_, POLLIN, 0}};
  std::vector<std::size_t> port_of;
  {
    const MutexLock lock(mutex_);
    look_after_connections();
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      for (const int socket : ports_[i].descriptors()) {
        waiting.push_back({socket, POLLIN, 0});
        port_of.push_back(i);
      }
    }
  }
  poll(waiting.data(), waiting.size(), kLookMilliseconds);
  eventfd_t none = 0;
  if (waiting.front().revents != 0) {
    // A port was reopened, so its sockets have changed, or a connection is to be cut.
    eventfd_read(wake_, &none);
    return;
  }
  bool has_descriptors = true;
  for (std::size_t i = 1; i < waiting.size(); ++i) {
    if (waiting[i].revents != 0) has_descriptors = accept_some(port_of[i - 1], waiting[i].fd) && has_descriptors;
  }
  if (!has_descriptors) std::this_thread::sleep_for(kPause);
}

bool Acceptor::accept_some(std::size_t port, int listener) {
  const MutexLock lock(mutex_);
  // It may have been closed since, and its number reused.
  const auto& open = ports_[port].descriptors();
  if (std::find(open.begin(), open.end(), listener) == open.end()) return true;
  for (int i = 0; i < kAtOnce; ++i) {
    sockaddr_storage peer{};
    socklen_t size = sizeof(peer);
    const int descriptor = accept4(listener, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor >= 0) {
      take(port, listener, descriptor, peer);
    } else if (lacks_descriptors(errno)) {
      refuse_with_reserve(listener);
      return false;
    } else if (errno != EINTR && errno != ECONNABORTED) {
      break;
    }
  }
  return true;
}

void Acceptor::refuse_with_reserve(int listener) {
  if (reserve_ < 0) return;
  close(reserve_);
  for (int i = 0; i < kAtOnce; ++i) {
    const int descriptor = accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor < 0) break;
    close(descriptor);
    parts_.refused("a connection: the daemon is out of file descriptors. Raise the limit (ulimit -n)");
  }
  reserve_ = open_reserve();
}

void Acceptor::take(std::size_t port, int listener, int descriptor, const sockaddr_storage& address) {
  std::string peer = peer_of(address);
  ucred user{};
  socklen_t size = sizeof(user);
  const bool is_unix = ports_[port].address().kind == ListenAddress::Kind::unix_socket &&
                       getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &user, &size) == 0;
  const bool is_owner = is_unix && user.uid == geteuid();
  if (is_unix && !is_owner) peer = "Unix user " + std::to_string(user.uid);
  const auto excess = (is_owner ? of_owner_ : of_others_).admit(descriptor, peer, name_of(address));
  if (!excess) {
    parts_.hand_over(port, listener, descriptor);
    return;
  }
  parts_.refused("a connection from " + peer + ": " + *excess);
  if (turned_away_.admit(descriptor, peer)) {
    close(descriptor);
  } else {
    parts_.turn_away(port, listener, descriptor);
  }
}

}  // namespace cellcrush::net
