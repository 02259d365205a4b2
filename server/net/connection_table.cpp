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

std::optional<std::string> ConnectionTable::admit(int descriptor, const std::string& peer, const std::string& name) {
  if (excess(peer) && Clock::now() - last_look_ >= kBetweenLooks) drop_closed();
  if (auto words = excess(peer); words && !close_a_stranger(peer)) return words;
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return "it is already closed";
  // A reused number belonged to a closed connection.
  if (const auto before = entries_.find(descriptor); before != entries_.end()) erase(before);
  entries_[descriptor] = {status.st_dev, status.st_ino, peer, name, "", next_number_++};
  ++peers_[peer];
  if (!name.empty()) names_[name] = descriptor;
  return std::nullopt;
}

void ConnectionTable::know(int descriptor, const std::string& caller) {
  const auto entry = entries_.find(descriptor);
  if (entry == entries_.end() || !entry->second.caller.empty()) return;
  int& of_caller = callers_[caller];
  if (2 * of_caller >= limits_.per_peer) return;
  ++of_caller;
  entry->second.caller = caller;
}

void ConnectionTable::know(const std::string& name, const std::string& caller) {
  if (const auto found = names_.find(name); found != names_.end()) know(found->second, caller);
}

bool ConnectionTable::cut(const std::string& name) {
  const auto found = names_.find(name);
  if (found == names_.end()) return false;
  const auto entry = entries_.find(found->second);
  const bool was_open = is_open(entry->first, entry->second);
  // Unlike shutdown, this leaves nothing to be read. The connection's owner then closes it.
  const sockaddr nobody{AF_UNSPEC, {}};
  if (was_open) connect(entry->first, &nobody, sizeof(nobody));
  erase(entry);
  return was_open;
}

bool ConnectionTable::is_open(int descriptor, const Entry& entry) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && status.st_ino == entry.inode && status.st_dev == entry.device;
}

bool ConnectionTable::close_a_stranger(const std::string& peer) {
  const auto of_peer = peers_.find(peer);
  const bool at_the_peer = of_peer != peers_.end() && of_peer->second >= limits_.per_peer;
  auto oldest = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    const auto& [descriptor, each] = *entry;
    if (each.name.empty() || !each.caller.empty() || (at_the_peer && each.peer != peer)) continue;
    if (oldest == entries_.end() || each.number < oldest->second.number) oldest = entry;
  }
  if (oldest == entries_.end()) return false;
  // Its owner then closes it.
  if (is_open(oldest->first, oldest->second)) shutdown(oldest->first, SHUT_RDWR);
  erase(oldest);
  return true;
}

void ConnectionTable::drop_closed() {
  last_look_ = Clock::now();
  for (auto entry = entries_.begin(); entry != entries_.end();)
    entry = is_open(entry->first, entry->second) ? std::next(entry) : erase(entry);
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
  if (const auto caller = callers_.find(entry->second.caller); caller != callers_.end() && --caller->second == 0)
    callers_.erase(caller);
  if (const auto name = names_.find(entry->second.name); name != names_.end() && name->second == entry->first)
    names_.erase(name);
  return entries_.erase(entry);
}

std::string name_of(const sockaddr_storage& address) {
  if (address.ss_family == AF_INET) {
    const auto& name = reinterpret_cast<const sockaddr_in&>(address);
    return "ipv4:" + text_of(AF_INET, &name.sin_addr) + ":" + std::to_string(ntohs(name.sin_port));
  }
  if (address.ss_family != AF_INET6) return {};
  const auto& name = reinterpret_cast<const sockaddr_in6&>(address);
  const std::string port = ":" + std::to_string(ntohs(name.sin6_port));
  if (IN6_IS_ADDR_V4MAPPED(&name.sin6_addr)) return "ipv4:" + text_of(AF_INET, &name.sin6_addr.s6_addr[12]) + port;
  return "ipv6:%5B" + text_of(AF_INET6, &name.sin6_addr) + "%5D" + port;
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

std::string peer_of_name(const std::string& name) {
  constexpr std::size_t kIpv4 = 5;  // "ipv4:"
  constexpr std::size_t kIpv6 = 8;  // "ipv6:%5B"
  sockaddr_storage out{};
  if (name.starts_with("ipv4:")) {
    out.ss_family = AF_INET;
    const std::string host = name.substr(kIpv4, name.rfind(':') - kIpv4);
    inet_pton(AF_INET, host.c_str(), &reinterpret_cast<sockaddr_in&>(out).sin_addr);
  } else if (name.starts_with("ipv6:%5B")) {
    out.ss_family = AF_INET6;
    const std::string host = name.substr(kIpv6, name.find("%5D") - kIpv6);
    inet_pton(AF_INET6, host.c_str(), &reinterpret_cast<sockaddr_in6&>(out).sin6_addr);
  }
  return peer_of(out);
}

}  // namespace cellcrush::net
