#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "cellcrush/v1/event.pb.h"
#include "translate/case_words.h"

namespace cellcrush::watch {

/// Bytes that many messages share.
using SharedBytes = std::shared_ptr<const std::string>;

/// An encoded message of a watch. What all watchers are sent is encoded once and shared; each watcher's own fields
/// stand around it.
struct SentMessage {
  std::string before = {};
  SharedBytes shared = nullptr;  ///< null: none
  std::string after = {};
  int skipped_frames = 0;    ///< before this one
  bool is_numbered = false;  ///< a state or sample of a job

  [[nodiscard]] std::size_t size() const { return before.size() + (shared ? shared->size() : 0) + after.size(); }
  void append_to(std::string& to) const;

  template <class Message>
  [[nodiscard]] Message parsed() const {
    std::string bytes;
    append_to(bytes);
    Message out;
    out.ParseFromString(bytes);
    return out;
  }
};

/// With its words.
template <class Message>
SentMessage encode(Message message) {
  translate::add_words(message);
  return {.before = message.SerializeAsString()};
}

/// A message with these fields, encoded, and the other message as one more.
SentMessage nest(std::string fields, int field, SentMessage message);

/// The parts of a frame or mesh (sent_frame.h), encoded by the first who asks. Thread-safe.
class SharedParts {
 public:
  /// `make` returns the parts.
  template <class Make>
  const std::vector<SharedBytes>& get(const Make& make) const {
    std::call_once(once_, [&] {
      for (const auto& part : make()) parts_.push_back(std::make_shared<const std::string>(part.SerializeAsString()));
    });
    return parts_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::vector<SharedBytes> parts_;
};

}  // namespace cellcrush::watch
