#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace cellcrush::net {

/// The open connections of a kind, by the descriptors that gRPC has. gRPC does not say when it closes one; so the table
/// asks the kernel whether a descriptor is still the socket that was noted. Not thread-safe.
class ConnectionTable {
 public:
  using Clock = std::chrono::steady_clock;

  struct Limits {
    int in_all = 0;
    int per_peer = 0;
  };

  explicit ConnectionTable(Limits limits, std::function<Clock::time_point()> now = Clock::now)
      : limits_(limits), now_(std::move(now)) {}

  /// Notes a connection. Why it is one too many, in words, when it is: it is then not noted.
  std::optional<std::string> admit(int descriptor, const std::string& peer);

  /// Drops those that were closed.
  void drop_closed();

  /// Open when they were last looked at.
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
  std::function<Clock::time_point()> now_;
  Entries entries_;                   ///< by descriptor
  std::map<std::string, int> peers_;  ///< connections of each
  Clock::time_point last_look_;
};

/// Who is at the other end, as far as an address tells: that of IPv4, the network of IPv6 (its first 64 bits), "unix"
/// for a Unix socket.
std::string peer_of(const sockaddr_storage& address);

}  // namespace cellcrush::net
