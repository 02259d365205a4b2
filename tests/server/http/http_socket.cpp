#include "server/http/http_socket.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace cellcrush::testing {

HttpSocket::HttpSocket(int port, int receive_buffer, const char* from)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in own{};
  own.sin_family = AF_INET;
  inet_pton(AF_INET, from, &own.sin_addr);
  EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof(own)), 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const timeval patience{60, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  if (receive_buffer > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
}

HttpSocket::~HttpSocket() { close(socket_); }

void HttpSocket::send(const std::string& text) const {
  EXPECT_EQ(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
}

std::string HttpSocket::read_some() const {
  std::array<char, 65536> piece{};
  const auto count = read(socket_, piece.data(), piece.size());
  return {piece.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

std::string HttpSocket::read_to_end() const {
  std::string out;
  for (std::string next = read_some(); !next.empty(); next = read_some()) out += next;
  return out;
}

}  // namespace cellcrush::testing
