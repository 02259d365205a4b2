#pragma once

#include <chrono>
#include <cstdint>

namespace cellcrush::net {

/// What the callers of a daemon are held to, so that none of them takes the daemon from the others.
struct ConnectionLimits {
  int connections = 1000;                       ///< on TCP; the Unix sockets have as many of their own
  int connections_per_address = 500;            ///< of one caller's machine
  int streams = 2000;                           ///< watches, downloads, frames and reflection, open at once
  int streams_per_caller = 1000;                ///< of one token, certificate or, without either, of all who call
  std::int64_t memory_bytes = 256 << 20;        ///< that connections and the messages on them may take
  int threads = 16;                             ///< that answer calls other than streams and checks
  std::chrono::milliseconds handshake{5'000};   ///< within which a connection has said what it wants
  std::chrono::milliseconds idle{600'000};      ///< after which a connection without a call is closed
  std::chrono::milliseconds keepalive{60'000};  ///< after which a silent connection is asked for a sign of life
  std::chrono::milliseconds keepalive_answer{20'000};  ///< within which that sign must come
  std::chrono::milliseconds probe_interval{10'000};    ///< between two probes of the daemon's own ports
  std::chrono::milliseconds probe_patience{5'000};     ///< within which a port answers a probe
};

}  // namespace cellcrush::net
