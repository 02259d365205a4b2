#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "access/unix_user.h"

namespace cellcrush::access {
namespace {

// "0100007F:9C40", as the tables show an end: the words of the address in the machine's byte order, and the port. IPv4
// stands in tcp6 as well, mapped, for a socket of IPv6.
std::string text_of(const sockaddr_storage& end, bool as_ipv6) {
  in6_addr address{};
  in_port_t port = 0;
  if (end.ss_family == AF_INET6) {
    const auto& name = reinterpret_cast<const sockaddr_in6&>(end);
    address = name.sin6_addr;
    port = name.sin6_port;
  } else {
    const auto& name = reinterpret_cast<const sockaddr_in&>(end);
    address.s6_addr32[2] = htonl(0xffff);
    address.s6_addr32[3] = name.sin_addr.s_addr;
    port = name.sin_port;
  }
  std::string out;
  for (int word = as_ipv6 ? 0 : 3; word < 4; ++word) out += fmt::format("{:08X}", address.s6_addr32[word]);
  return out + fmt::format(":{:04X}", ntohs(port));
}

}  // namespace

std::optional<uid_t> user_in_socket_tables(const sockaddr_storage& own, const sockaddr_storage& peer) {
  for (const bool is_ipv6 : {false, true}) {
    if (!is_ipv6 && peer.ss_family != AF_INET) continue;
    const std::string wanted = text_of(peer, is_ipv6) + " " + text_of(own, is_ipv6) + " ";
    std::ifstream table(is_ipv6 ? "/proc/net/tcp6" : "/proc/net/tcp");
    for (std::string line; std::getline(table, line);) {
      const auto at = line.find(wanted);
      if (at == std::string::npos) continue;
      // "01 00000000:00000000 00:00000000 00000000  1000        0 23456 ..."
      std::istringstream rest(line.substr(at + wanted.size()));
      std::string unused;
      unsigned state = 0;
      uid_t user = 0;
      std::uint64_t inode = 0;
      rest >> std::hex >> state >> unused >> unused >> unused >> std::dec >> user >> unused >> inode;
      if (rest && state == TCP_ESTABLISHED && inode != 0) return user;
    }
  }
  return std::nullopt;
}

}  // namespace cellcrush::access
