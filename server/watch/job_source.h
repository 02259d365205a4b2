#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "watch/hub.h"
#include "watch/watch_cursor.h"

namespace cellcrush::watch {

/// Source of a WatchJob: a cursor, and the channel that wakes it. Not thread-safe, except for `wake`.
class JobSource {
 public:
  using Message = v1::JobEvent;
  static constexpr bool kIsWatch = true;

  /// Throws the errors of WatchCursor.
  JobSource(store::JournalReader& journal, Hub& hub, std::int64_t job, std::int64_t after, WatchCursor::Wanted wanted)
      : channel_(hub.open(job)), frames_(wanted.frames), cursor_(journal, hub, job, after, wanted) {}

  /// Calls `wake` from now on whenever there may be another message, on other threads and under locks: it must be
  /// quick.
  void open(std::function<void()> wake) { subscription_ = channel_->subscribe(std::move(wake), frames_); }
  /// Once this returns, `wake` is not called again.
  void close() { channel_->unsubscribe(subscription_); }

  std::optional<SentMessage> next() { return cursor_.next(); }
  /// Whether the next message is available without waiting.
  [[nodiscard]] bool has_more() const { return cursor_.has_more(); }
  [[nodiscard]] bool is_quiet() const { return cursor_.is_quiet(); }
  [[nodiscard]] bool ended() const { return cursor_.ended(); }
  [[nodiscard]] SentMessage bookmark() const { return cursor_.bookmark(); }
  /// How to continue a watch that was closed, as the end of a sentence.
  [[nodiscard]] std::string resume_advice() const {
    return "with after_sequence " + std::to_string(cursor_.sequence());
  }

 private:
  std::shared_ptr<Channel> channel_;
  bool frames_;
  WatchCursor cursor_;
  std::uint64_t subscription_ = 0;
};

}  // namespace cellcrush::watch
