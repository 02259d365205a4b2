#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace cellcrush::net {

/// The open connections of one kind, by descriptor. gRPC does not announce when it closes one, so the table asks the
/// kernel whether a descriptor is still the recorded socket. Not thread-safe.
class ConnectionTable {
 public:
  using Clock = std::chrono::steady_clock;

  struct Limits {
    int in_all = 0;
    int per_peer = 0;
  };

  explicit ConnectionTable(Limits limits) : limits_(limits) {}

  /// Records a connection. If it exceeds a limit, returns the reason and does not record it.
  std::optional<std::string> admit(int descriptor, const std::string& peer);

  /// Drops closed connections.
  void drop_closed();

  /// Number open at the last check.
  [[nodiscard]] std::size_t count() const { return entries_.size(); }

 private:
  struct Entry {
    dev_t device = 0;
    ino_t inode = 0;
    std::string peer;
  };
  using Entries = std::map<int, Entry>;

  [[nodiscard]] std::optional<std::string> excess(const std::string& peer) const;
  Entries::iterator erase(Entries::iterator entry);

  Limits limits_;
  Entries entries_;                   ///< by descriptor
  std::map<std::string, int> peers_;  ///< connections by peer
  Clock::time_point last_look_;
};

/// The peer as far as its address identifies it: the IPv4 address, the IPv6 network (first 64 bits), or "unix".
std::string peer_of(const sockaddr_storage& address);

}  // namespace cellcrush::net
