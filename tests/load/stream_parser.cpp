#include "load/stream_parser.h"

#include <algorithm>

#include "http/connect_protocol.h"

namespace cellcrush::load {
namespace {

constexpr std::size_t kEnvelopePrefix = 5;

}  // namespace

void StreamParser::add(std::string_view bytes) {
  while (!bytes.empty()) {
    if (chunk_left_ > 0) {
      const auto piece = bytes.substr(0, chunk_left_);
      chunk_left_ -= piece.size();
      bytes.remove_prefix(piece.size());
      add_body(piece);
      continue;
    }
    line_ += bytes.front();
    bytes.remove_prefix(1);
    if (!line_.ends_with(in_body_ ? "\r\n" : "\r\n\r\n")) continue;
    if (in_body_ && line_.size() > 2) chunk_left_ = std::stoul(line_, nullptr, 16);
    in_body_ = true;
    line_.clear();
  }
}

void StreamParser::add_body(std::string_view bytes) {
  body_ += bytes;
  std::size_t at = 0;
  while (body_.size() - at >= kEnvelopePrefix) {
    std::size_t size = 0;
    for (std::size_t i = 1; i < kEnvelopePrefix; ++i) size = size << 8U | static_cast<unsigned char>(body_[at + i]);
    if (body_.size() - at < kEnvelopePrefix + size) break;
    const auto message = std::string_view(body_).substr(at + kEnvelopePrefix, size);
    if (body_[at] == static_cast<char>(http::kEndOfStream)) {
      end_ = message;
    } else {
      on_message_(message);
    }
    at += kEnvelopePrefix + size;
  }
  body_.erase(0, at);
}

}  // namespace cellcrush::load
