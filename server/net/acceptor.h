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

/// Accepts connections on all ports of the daemon in its own thread, and hands over those within the limits. gRPC 1.51
/// permanently stops accepting on a port after EMFILE and has no cap on connections. This class keeps a descriptor in
/// reserve to refuse connections, and resumes once descriptors are available. Thread-safe.
class Acceptor {
 public:
  /// Takes ownership of a connected socket from the port with this index, non-blocking and close-on-exec.
  using HandOver = std::function<void(std::size_t port, int listener, int descriptor)>;
  /// Records a connection beyond the limits; `why` is for the log.
  using Refused = std::function<void(const std::string& why)>;

  /// Called about once a second with the number of open connections.
  using Counted = std::function<void(std::size_t open)>;

  struct Parts {
    HandOver hand_over;
    HandOver turn_away;  ///< receives a few connections beyond the limits, to return the reason; the others are closed
    Refused refused;
    Counted counted;
  };

  /// Accepts from `start` on. The ports already listen: earlier connections wait.
  Acceptor(std::vector<ListeningPort> ports, const ConnectionLimits& limits, Parts parts);
  ~Acceptor();
  Acceptor(const Acceptor&) = delete;
  Acceptor& operator=(const Acceptor&) = delete;

  void start();

  /// A call of the caller was admitted on the connection of this name (ConnectionTable::know).
  void know(const std::string& name, const std::string& caller) {
    const MutexLock lock(mutex_);
    of_others_.know(name, caller);
  }

  /// Closes the connection of this name soon, and drops what it has sent.
  void cut(const std::string& name);

  /// Closes the ports; connections handed over stay open.
  void stop();

  [[nodiscard]] std::vector<ListenAddress> addresses() const;

  /// Closes a port and listens on its address again. Throws ServiceError (failed_precondition) if that fails; may be
  /// retried.
  void reopen(std::size_t port);

 private:
  void run(const std::stop_token& stop);
  void wait_and_accept();
  /// Accepts the pending connections of a socket; false if no descriptor was available.
  bool accept_some(std::size_t port, int listener);
  /// Refuses a connection with the reserve descriptor if no other is available.
  void refuse_with_reserve(int listener) CELLCRUSH_REQUIRES(mutex_);
  void take(std::size_t port, int listener, int descriptor, const sockaddr_storage& peer) CELLCRUSH_REQUIRES(mutex_);
  void wake() const;
  void cut_connections();
  void look_after_connections() CELLCRUSH_REQUIRES(mutex_);

  ConnectionLimits limits_;
  Parts parts_;
  mutable Mutex mutex_;
  std::vector<ListeningPort> ports_ CELLCRUSH_GUARDED_BY(mutex_);
  ConnectionTable of_others_ CELLCRUSH_GUARDED_BY(mutex_);
  /// Those of the user that runs the daemon, on Unix sockets. Separate, so that others cannot shut out the owner.
  ConnectionTable of_owner_ CELLCRUSH_GUARDED_BY(mutex_);
  ConnectionTable turned_away_ CELLCRUSH_GUARDED_BY(mutex_);
  int reserve_ CELLCRUSH_GUARDED_BY(mutex_) = -1;
  bool closed_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::chrono::steady_clock::time_point last_count_ CELLCRUSH_GUARDED_BY(mutex_);
  Mutex cuts_mutex_;  ///< held for a moment: gRPC may cut a connection while it is given another one
  std::vector<std::string> cuts_ CELLCRUSH_GUARDED_BY(cuts_mutex_);
  const int wake_;  ///< eventfd
  std::jthread thread_;
};

}  // namespace cellcrush::net
