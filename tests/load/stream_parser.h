#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace cellcrush::load {

/// Reads the answer to one streaming call of the Connect protocol over HTTP/1.1, piece by piece as it comes.
class StreamParser {
 public:
  using OnMessage = std::function<void(std::string_view message)>;

  /// `on_message` gets each message in order, without its prefix, but not the last envelope.
  explicit StreamParser(OnMessage on_message) : on_message_(std::move(on_message)) {}

  void add(std::string_view bytes);

  /// What the last envelope says, as JSON; empty before it came.
  [[nodiscard]] const std::string& end() const { return end_; }

 private:
  void add_body(std::string_view bytes);

  OnMessage on_message_;
  std::string line_;            ///< headers, or the size of a chunk, so far
  bool in_body_ = false;        ///< the headers are complete
  std::size_t chunk_left_ = 0;  ///< bytes of the chunk that follow
  std::string body_;            ///< without a complete envelope
  std::string end_;
};

}  // namespace cellcrush::load
