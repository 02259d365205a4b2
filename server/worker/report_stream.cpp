#include "worker/report_stream.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <string>

namespace cellcrush::worker {
namespace {

constexpr std::uint32_t kLargest = 1U << 30U;

bool send_all(int socket, const char* data, std::size_t size) {
  while (size > 0) {
    const auto sent = send(socket, data, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    data += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, char* data, std::size_t size) {
  while (size > 0) {
    const auto received = recv(socket, data, size, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    data += received;
    size -= static_cast<std::size_t>(received);
  }
  return true;
}

}  // namespace

bool ReportStream::write(const google::protobuf::MessageLite& message) {
  const std::string bytes = message.SerializeAsString();
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::array<char, 4> length{};
  for (unsigned i = 0; i < 4; ++i) length[i] = static_cast<char>((size >> (8U * i)) & 0xFFU);
  return send_all(socket_, length.data(), length.size()) && send_all(socket_, bytes.data(), bytes.size());
}

ReportStream::Read ReportStream::read(google::protobuf::MessageLite& message) {
  std::array<unsigned char, 4> length{};
  if (!receive_all(socket_, reinterpret_cast<char*>(length.data()), length.size())) return Read::end;
  std::uint32_t size = 0;
  for (unsigned i = 0; i < 4; ++i) size |= static_cast<std::uint32_t>(length[i]) << (8U * i);
  if (size > kLargest) return Read::broken;
  std::string bytes(size, '\0');
  if (!receive_all(socket_, bytes.data(), bytes.size())) return Read::end;
  return message.ParseFromString(bytes) ? Read::message : Read::broken;
}

bool ReportStream::at_end() const {
  char next = 0;
  return recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

}  // namespace cellcrush::worker
