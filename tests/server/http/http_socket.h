#pragma once

#include <cstddef>
#include <string>

namespace cellcrush::testing {

/// A plain connection to a port of 127.0.0.1. Reading waits at most 60 s.
class HttpSocket {
 public:
  /// `receive_buffer`: bytes that the kernel keeps unread; 0: its default. `from`: an address of loopback.
  explicit HttpSocket(int port, int receive_buffer = 0, const char* from = "127.0.0.1");
  ~HttpSocket();
  HttpSocket(const HttpSocket&) = delete;
  HttpSocket& operator=(const HttpSocket&) = delete;

  [[nodiscard]] int number() const { return socket_; }
  void send(const std::string& text) const;
  /// What comes next; empty at the end.
  [[nodiscard]] std::string read_some() const;
  [[nodiscard]] std::string read_to_end() const;

 private:
  int socket_ = -1;
};

}  // namespace cellcrush::testing
