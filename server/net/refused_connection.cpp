#include "net/refused_connection.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace cellcrush::net {
namespace {

constexpr std::size_t kMostOpen = 16;
constexpr std::chrono::milliseconds kMoment{500};
constexpr std::uint8_t kSettings = 4;
constexpr std::uint8_t kGoAway = 7;
constexpr char kEnhanceYourCalm = 11;

// A frame of stream 0 without flags.
std::string frame_of(std::uint8_t type, const std::string& payload) {
  std::string out;
  for (const int shift : {16, 8, 0}) out.push_back(static_cast<char>((payload.size() >> shift) & 0xFFU));
  out.push_back(static_cast<char>(type));
  out.append(5, '\0');
  return out + payload;
}

}  // namespace

RefusedConnections::~RefusedConnections() {
  while (!open_.empty()) close_first();
}

void RefusedConnections::add(int descriptor, const std::string& reason) {
  std::string payload(7, '\0');  // no stream was served
  payload.push_back(kEnhanceYourCalm);
  const std::string bytes = frame_of(kSettings, "") + frame_of(kGoAway, payload + reason);
  // A client that does not take a few hundred bytes at once does without the reason.
  static_cast<void>(send(descriptor, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
  shutdown(descriptor, SHUT_WR);
  if (open_.size() == kMostOpen) close_first();
  open_.push_back({descriptor, Clock::now()});
}

void RefusedConnections::close_old() {
  while (!open_.empty() && Clock::now() - open_.front().since > kMoment) close_first();
}

void RefusedConnections::close_first() {
  // What the client has sent is taken: bytes that are left unread would make the close a reset.
  std::array<char, 4096> unread{};
  while (recv(open_.front().descriptor, unread.data(), unread.size(), MSG_DONTWAIT) > 0) continue;
  close(open_.front().descriptor);
  open_.pop_front();
}

}  // namespace cellcrush::net
