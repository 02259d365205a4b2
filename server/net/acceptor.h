#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "mutex.h"
#include "net/connection_limits.h"
#include "net/connection_table.h"
#include "net/listening_port.h"

namespace cellcrush::net {

/// Accepts connections on all ports of the daemon, in a thread of its own, and hands over those that the limits allow.
/// gRPC 1.51 stops to accept on a port for good once it has met EMFILE, and has no cap on connections; this has a
/// descriptor in reserve, with which it refuses what cannot be served, and goes on when there are descriptors again.
/// Thread-safe.
class Acceptor {
 public:
  /// Takes a connected socket of the port with that index, non-blocking and close-on-exec.
  using HandOver = std::function<void(std::size_t port, int listener, int descriptor)>;
  /// Notes a connection beyond the limits; `why` is for the log.
  using Refused = std::function<void(const std::string& why)>;

  /// Called about once a second with the number of open connections.
  using Counted = std::function<void(std::size_t open)>;

  struct Parts {
    HandOver hand_over;
    HandOver turn_away;  ///< is given a few of those beyond the limits, to say why; the others are closed
    Refused refused;
    Counted counted;
  };

  /// Accepts from `start` on. The ports listen already: what connects meanwhile waits.
  Acceptor(std::vector<ListeningPort> ports, const ConnectionLimits& limits, Parts parts);
  ~Acceptor() { stop(); }
  Acceptor(const Acceptor&) = delete;
  Acceptor& operator=(const Acceptor&) = delete;

  void start();

  /// Closes the ports; connections that were handed over live on.
  void stop();

  [[nodiscard]] std::vector<ListenAddress> addresses() const;

  /// Closes a port and listens on its address again. Throws ServiceError (failed_precondition) when that cannot be; it
  /// may be tried again.
  void reopen(std::size_t port);

 private:
  void run(const std::stop_token& stop);
  void wait_and_accept();
  /// Accepts what waits on a socket; false when there was no descriptor for it.
  bool accept_some(std::size_t port, int listener);
  /// A connection for which there is no descriptor is refused with the one in reserve.
  void refuse_with_reserve(int listener) CELLCRUSH_REQUIRES(mutex_);
  void take(std::size_t port, int listener, int descriptor, const sockaddr_storage& peer) CELLCRUSH_REQUIRES(mutex_);
  void wake() const;
  void look_after_connections() CELLCRUSH_REQUIRES(mutex_);

  ConnectionLimits limits_;
  Parts parts_;
  mutable Mutex mutex_;
  std::vector<ListeningPort> ports_ CELLCRUSH_GUARDED_BY(mutex_);
  ConnectionTable on_tcp_ CELLCRUSH_GUARDED_BY(mutex_);
  /// Apart, so that strangers cannot shut the owner out.
  ConnectionTable on_unix_sockets_ CELLCRUSH_GUARDED_BY(mutex_);
  ConnectionTable turned_away_ CELLCRUSH_GUARDED_BY(mutex_);
  int reserve_ CELLCRUSH_GUARDED_BY(mutex_) = -1;
  bool closed_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::chrono::steady_clock::time_point last_count_ CELLCRUSH_GUARDED_BY(mutex_);
  const int wake_;  ///< eventfd, which is there until closed_
  std::jthread thread_;
};

}  // namespace cellcrush::net
