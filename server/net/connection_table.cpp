#include "net/connection_table.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>

namespace cellcrush::net {
namespace {

// A flood of connections must not trigger a scan of the table for each.
constexpr std::chrono::milliseconds kBetweenLooks{50};

std::string text_of(int family, const void* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  return inet_ntop(family, address, text.data(), text.size()) != nullptr ? text.data() : "unknown";
}

}  // namespace

std::optional<std::string> ConnectionTable::admit(int descriptor, const std::string& peer) {
  if (excess(peer) && Clock::now() - last_look_ >= kBetweenLooks) drop_closed();
  if (auto words = excess(peer)) return words;
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return "it is already closed";
  // A reused number belonged to a closed connection.
  if (const auto before = entries_.find(descriptor); before != entries_.end()) erase(before);
  entries_[descriptor] = {status.st_dev, status.st_ino, peer};
  ++peers_[peer];
  return std::nullopt;
}

void ConnectionTable::drop_closed() {
  last_look_ = Clock::now();
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    struct stat status {};
    const bool is_open = fstat(entry->first, &status) == 0 && status.st_ino == entry->second.inode &&
                         status.st_dev == entry->second.device;
    entry = is_open ? std::next(entry) : erase(entry);
  }
}

std::optional<std::string> ConnectionTable::excess(const std::string& peer) const {
  const auto of_peer = peers_.find(peer);
  if (of_peer != peers_.end() && of_peer->second >= limits_.per_peer) {
    return peer + " has " + std::to_string(of_peer->second) +
           " connections open, the limit of --max-connections-per-address. Close some";
  }
  if (static_cast<int>(entries_.size()) < limits_.in_all) return std::nullopt;
  return std::to_string(entries_.size()) +
         " connections are open, the limit of --max-connections or of file descriptors. Try again later";
}

ConnectionTable::Entries::iterator ConnectionTable::erase(Entries::iterator entry) {
  const auto peer = peers_.find(entry->second.peer);
  if (--peer->second == 0) peers_.erase(peer);
  return entries_.erase(entry);
}

std::string peer_of(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) return text_of(AF_INET, &reinterpret_cast<const sockaddr_in&>(address).sin_addr);
  if (address.ss_family != AF_INET6) return "unix";
  in6_addr network = reinterpret_cast<const sockaddr_in6&>(address).sin6_addr;
  if (IN6_IS_ADDR_V4MAPPED(&network)) return text_of(AF_INET, &network.s6_addr[12]);
  if (IN6_IS_ADDR_LOOPBACK(&network)) return "::1";
  std::fill(network.s6_addr + 8, network.s6_addr + 16, std::uint8_t{0});
  return text_of(AF_INET6, &network) + "/64";
}

}  // namespace cellcrush::net
