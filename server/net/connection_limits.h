#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace cellcrush::net {

/// Limits on callers, so that none can exhaust the daemon.
struct ConnectionLimits {
  int connections = 1000;                      ///< the daemon's own user has a separate limit on Unix sockets
  int connections_per_address = 500;           ///< from one remote machine, or of one other Unix user
  int streams = 2000;                          ///< open watches, downloads, frames and reflection
  int streams_per_caller = 1000;               ///< of one Unix user, token or certificate; without any, of one address
  std::int64_t memory_bytes = 256 << 20;       ///< for connections and their messages
  int threads = 16;                            ///< for calls other than streams and checks
  std::chrono::milliseconds handshake{5'000};  ///< deadline for a new connection to complete its handshake
  std::chrono::milliseconds idle{600'000};     ///< a connection without a call is closed after this time
  std::chrono::milliseconds keepalive{60'000};         ///< a silent connection is pinged after this time
  std::chrono::milliseconds keepalive_answer{20'000};  ///< deadline for the answer to a ping
  std::chrono::milliseconds probe_interval{10'000};    ///< interval between probes of the daemon's own ports
  std::chrono::milliseconds probe_patience{5'000};     ///< deadline for a port to answer a probe
};

/// Raises the soft limit on file descriptors to the hard limit. Returns how many connections may be open, between 8 and
/// `wanted`, so that enough descriptors remain for the journal, results and `workers` jobs. Logs a warning if that is
/// fewer than wanted.
int raise_descriptor_limit(int wanted, int workers);

/// Returns memory to the system after floods of connections and large requests. The C library would otherwise keep its
/// peak. Not thread-safe.
class HeapTrim {
 public:
  /// Called about once a second: returns what was freed since, if it is much.
  void look();

 private:
  std::size_t free_ = 0;  ///< least free bytes of the heap since memory was last returned, which keeps some
};

}  // namespace cellcrush::net
