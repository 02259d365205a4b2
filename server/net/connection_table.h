#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
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

  /// Records a connection, with its name if it has one. At a limit the oldest connection of a stranger is closed for
  /// it, so that idle strangers lock nobody out; those without a name are no strangers. If there is none, returns the
  /// reason and does not record it.
  std::optional<std::string> admit(int descriptor, const std::string& peer, const std::string& name = {});

  /// A call of this caller was admitted on the connection, which is no stranger's any more, while the caller has no
  /// more than half of the places of an address.
  void know(int descriptor, const std::string& caller);
  void know(const std::string& name, const std::string& caller);

  /// Closes the connection of this name, and drops what was received on it. False if there is none.
  bool cut(const std::string& name);

  /// Drops closed connections.
  void drop_closed();

  /// Number open at the last check.
  [[nodiscard]] std::size_t count() const { return entries_.size(); }

 private:
  struct Entry {
    dev_t device = 0;
    ino_t inode = 0;
    std::string peer;
    std::string name;
    std::string caller;        ///< empty: a stranger
    std::uint64_t number = 0;  ///< in order of arrival
  };
  using Entries = std::map<int, Entry>;

  [[nodiscard]] std::optional<std::string> excess(const std::string& peer) const;
  Entries::iterator erase(Entries::iterator entry);
  [[nodiscard]] static bool is_open(int descriptor, const Entry& entry);
  /// Closes the oldest connection of a stranger, at the peer if it is at its limit. False if there is none.
  bool close_a_stranger(const std::string& peer);

  Limits limits_;
  Entries entries_;                     ///< by descriptor
  std::map<std::string, int> peers_;    ///< connections by peer
  std::map<std::string, int> callers_;  ///< connections by caller
  std::map<std::string, int> names_;    ///< descriptors by name
  std::uint64_t next_number_ = 0;
  Clock::time_point last_look_;
};

/// The name under which gRPC knows a connection of TCP: "ipv4:127.0.0.1:40312"; empty for others.
std::string name_of(const sockaddr_storage& address);

/// The peer as far as its address identifies it: the IPv4 address, the IPv6 network (first 64 bits), or "unix".
std::string peer_of(const sockaddr_storage& address);
std::string peer_of_name(const std::string& name);  ///< by that name of the connection

}  // namespace cellcrush::net
