#pragma once

#include <grpcpp/support/status.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "error_table.h"
#include "jobs/case_field.h"
#include "metrics/metrics.h"
#include "rpc/preparation.h"
#include "rpc/stream_limits.h"
#include "watch/pump.h"
#include "watch/sent_message.h"
#include "watch/watch_times.h"

namespace cellcrush::rpc {

/// Dependencies of streams; all outlive them.
struct StreamParts {
  watch::Pump& pump;
  CallPool& checks;  ///< for what a source prepares
  metrics::Metrics& metrics;
  StreamLimits& limits;
  watch::WatchTimes times;
};

/// Number of frames skipped before this message.
inline int skipped_before(const watch::SentMessage& message) { return message.skipped_frames; }
inline int skipped_before(const google::protobuf::Message&) { return 0; }

/// For the metrics: how long events wait for their messages. Thread-safe.
class EventDelay {
 public:
  /// Something has changed.
  void begin() {
    std::int64_t none = 0;
    since_.compare_exchange_strong(none, Clock::now().time_since_epoch().count());
  }
  /// A message goes out.
  void end(metrics::Metrics& metrics) {
    const std::int64_t since = since_.exchange(0);
    if (since == 0) return;
    const Clock::duration taken = Clock::now().time_since_epoch() - Clock::duration(since);
    metrics.observe_event(std::chrono::duration<double>(taken).count());
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::atomic<std::int64_t> since_ = 0;  ///< Clock's count at the first change without a message yet; 0: none
};

/// What most sources have: nothing wakes them, a message is read when it is asked for, and there is no bookmark.
template <class M>
class PlainSource {
 public:
  using Message = M;
  static constexpr bool kIsWatch = false;

  void open(const std::function<void()>&) {}
  void close() {}
  [[nodiscard]] bool has_more() const { return false; }
  [[nodiscard]] std::optional<Message> bookmark() const { return std::nullopt; }
};

/// A plain source that reads several messages at once and sends them one by one.
template <class M>
class QueuedSource : public PlainSource<M> {
 public:
  virtual ~QueuedSource() = default;

  std::optional<M> next() {
    if (messages_.empty() && !is_read_) read();
    if (messages_.empty()) return std::nullopt;
    M out = std::move(messages_.front());
    messages_.pop_front();
    return out;
  }
  [[nodiscard]] bool has_more() const { return !messages_.empty(); }
  [[nodiscard]] bool ended() const { return is_read_ && messages_.empty(); }

 protected:
  /// Adds the next messages.
  virtual void read() = 0;

  std::deque<M> messages_;  ///< still to send
  bool is_read_ = false;    ///< whether the last message was read
};

/// What an open stream sends next and how it ends, for StreamReactor and SourceStream, which carry the messages.
/// Source is JobSource, JobsSource, SweepSource, DownloadSource, FrameSource or HealthSource, or has the same members:
///   Message, kIsWatch   type of the messages; whether the metrics count it as a watch
///   open(wake), close   start and end of the calls to `wake` on changes
///   next, has_more      the next message, if there is one, as a Message or encoded (watch::SentMessage); whether it is
///                       available without waiting for the disk
///   is_quiet            whether next has nothing before the next call to `wake`; may be absent
///   ended               whether the last message was sent
///   bookmark            message to send after a long idle time; may be absent
///   resume_advice       how to continue a closed stream, as the end of a sentence
/// and perhaps:
///   prepare(call)       long work before the first message, until call.is_cancelled(), on a thread of its own; until
///                       then only is_large, resume_advice and close are called
///   is_large            whether that may take seconds
/// Not thread-safe.
template <class Source>
class StreamState {
 public:
  using Sent = typename decltype(std::declval<Source&>().next())::value_type;

  /// Throws ServiceError (exhausted) if the caller, or all callers, have too many open streams.
  StreamState(const StreamParts& parts, const std::string& caller, std::unique_ptr<Source> source)
      : parts_(parts), permit_(parts.limits.admit(caller)), caller_(caller), source_(std::move(source)) {
    if (Source::kIsWatch) parts_.metrics.count_watcher(1);
  }
  ~StreamState() {
    if (preparation_) preparation_->cancel();
    if (Source::kIsWatch) parts_.metrics.count_watcher(-1);
  }
  StreamState(const StreamState&) = delete;
  StreamState& operator=(const StreamState&) = delete;

  Source& source() { return *source_; }

  /// Begins to serve the source. `wake`: called when there may be something to send.
  void open(const std::function<void()>& wake) {
    source_->open(wake);
    if constexpr (requires(const Call& call) { source_->prepare(call); }) {
      preparation_ = std::make_shared<Preparation>(caller_);
      preparation_->begin(
          parts_.checks, source_->is_large(), [source = source_](const Call& call) { source->prepare(call); }, wake);
    }
  }

  /// Nobody reads any more.
  void close() {
    if (preparation_) preparation_->cancel();
    source_->close();
  }

  /// The next message; nothing if there is none now, or if the stream has ended: then `status` says how.
  std::optional<Sent> next() {
    try {
      const bool is_ready = !preparation_ || preparation_->is_done();
      if (preparation_ && is_ready && !preparation_->status().ok()) {
        status_ = preparation_->status();
        return std::nullopt;
      }
      auto out = is_ready ? source_->next() : std::nullopt;
      if (!out && is_ready && source_->ended()) {
        status_ = grpc::Status::OK;
      } else if (!out && parts_.pump.draining()) {
        status_ = {grpc::StatusCode::UNAVAILABLE,
                   "The daemon is shutting down. Ask again " + source_->resume_advice() + " after it restarts."};
      } else if (!out && is_ready && Clock::now() - last_write_ >= parts_.times.bookmark_interval) {
        out = source_->bookmark();
        last_write_ = Clock::now();  // one is enough
      }
      return out;
    } catch (const std::exception& error) {
      status_ = status_of(error);
      return std::nullopt;
    }
  }

  /// Whether next has nothing before the source calls `wake`. False if only next can tell.
  [[nodiscard]] bool is_quiet() const {
    if constexpr (requires { source_->is_quiet(); }) return !parts_.pump.draining() && source_->is_quiet();
    return false;
  }

  [[nodiscard]] const std::optional<grpc::Status>& status() const { return status_; }

  /// Messages of that many bytes are being sent. False if all streams together would hold too many bytes: the stream
  /// then ends.
  bool begin_write(std::size_t bytes) {
    try {
      permit_.hold(bytes);
    } catch (const std::exception& error) {
      status_ = status_of(error);
      return false;
    }
    last_write_ = Clock::now();
    return true;
  }

  /// They were sent.
  void end_write() { permit_.hold(0); }

  /// Whether the client has left a message unread for too long.
  [[nodiscard]] bool is_stuck() const { return Clock::now() - last_write_ > patience(); }
  [[nodiscard]] bool is_to_be_abandoned() const {
    const auto& times = parts_.times;
    const auto grace = parts_.limits.is_short() ? std::min(times.grace, times.grace_when_short) : times.grace;
    return Clock::now() - last_write_ > patience() + grace;
  }

  [[nodiscard]] grpc::Status status_of_stuck() const {
    const auto seconds = std::chrono::duration<double>(patience()).count();
    return {grpc::StatusCode::RESOURCE_EXHAUSTED, "The client read nothing from this stream for " +
                                                      jobs::text_of(seconds) +
                                                      " s, so the stream was closed. Ask again " +
                                                      source_->resume_advice() + ", and read messages without delay."};
  }

  void count_skipped(const Sent& message) {
    if (const int skipped = skipped_before(message); skipped > 0) parts_.metrics.count_skipped_frames(skipped);
  }

 private:
  using Clock = std::chrono::steady_clock;

  // With an unread message; less while it may keep others out.
  [[nodiscard]] std::chrono::milliseconds patience() const {
    const auto& times = parts_.times;
    if (!parts_.limits.is_short()) return times.patience;
    return std::min(times.patience, times.patience_when_short + std::chrono::milliseconds(permit_.bytes() / 100));
  }

  StreamParts parts_;
  StreamLimits::Permit permit_;
  std::string caller_;
  std::shared_ptr<Source> source_;            ///< shared with what it prepares
  std::shared_ptr<Preparation> preparation_;  ///< null for a source without one
  std::optional<grpc::Status> status_;
  Clock::time_point last_write_ = Clock::now();
};

}  // namespace cellcrush::rpc
