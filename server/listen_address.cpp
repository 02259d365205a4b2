#include "listen_address.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <charconv>
#include <filesystem>

#include "error.h"

namespace cellcrush {
namespace {

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw ServiceError(ServiceError::Kind::invalid, "Cannot listen on \"" + std::string(text) + "\": " + why);
}

// Whether it is an IPv6 "[ADDRESS]".
bool read_ipv6(const std::string& host, in6_addr& address) {
  if (host.size() < 2 || host.front() != '[' || host.back() != ']') return false;
  return inet_pton(AF_INET6, host.substr(1, host.size() - 2).c_str(), &address) == 1;
}

bool is_address(const std::string& host) {
  in_addr ipv4{};
  in6_addr ipv6{};
  return host == "localhost" || inet_pton(AF_INET, host.c_str(), &ipv4) == 1 || read_ipv6(host, ipv6);
}

ListenAddress parse_unix(std::string_view text, std::string_view path) {
  if (path.empty()) refuse(text, "the path is missing. Use unix:PATH.");
  ListenAddress out{ListenAddress::Kind::unix_socket, std::filesystem::absolute(path).string(), 0};
  const std::size_t limit = sizeof(sockaddr_un::sun_path) - 1;
  if (out.place.size() > limit) {
    refuse(text, "a socket path has at most " + std::to_string(limit) + " characters, and this one has " +
                     std::to_string(out.place.size()) + ". Use a shorter path.");
  }
  return out;
}

}  // namespace

std::string ListenAddress::text() const {
  return kind == Kind::unix_socket ? "unix:" + place : place + ":" + std::to_string(port);
}

bool ListenAddress::is_loopback() const {
  if (kind == Kind::unix_socket || place == "localhost") return true;
  in_addr ipv4{};
  if (inet_pton(AF_INET, place.c_str(), &ipv4) == 1) return (ntohl(ipv4.s_addr) >> 24U) == 127U;
  in6_addr ipv6{};
  return read_ipv6(place, ipv6) && IN6_IS_ADDR_LOOPBACK(&ipv6);
}

ListenAddress parse_listen_address(std::string_view text, const std::string& use) {
  if (text.starts_with("unix:")) return parse_unix(text, text.substr(5));
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) refuse(text, "use " + use + ".");
  ListenAddress out{ListenAddress::Kind::tcp, std::string(text.substr(0, colon)), 0};
  const std::string_view digits = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out.port);
  if (error != std::errc() || end != digits.data() + digits.size() || out.port < 0 || out.port > 65535)
    refuse(text, "the port must be a number from 0 to 65535; 0 picks a free port.");
  if (!is_address(out.place)) {
    refuse(text,
           "the host is not an address of this machine. Use 127.0.0.1, localhost or [::1], another of its addresses, "
           "or 0.0.0.0 for all.");
  }
  return out;
}

}  // namespace cellcrush
