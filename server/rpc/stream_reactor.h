#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/jobs_service.pb.h"
#include "error_table.h"
#include "jobs/case_field.h"
#include "metrics/metrics.h"
#include "mutex.h"
#include "rpc/refused_stream.h"
#include "rpc/stream_limits.h"
#include "watch/pump.h"
#include "watch/watch_times.h"

namespace cellcrush::rpc {

/// Dependencies of streams; all outlive them.
struct StreamParts {
  watch::Pump& pump;
  metrics::Metrics& metrics;
  StreamLimits& limits;
  watch::WatchTimes times;
};

/// Number of frames skipped before this message.
inline int skipped_before(const v1::JobEvent& event) { return event.has_frame() ? event.frame().skipped() : 0; }
inline int skipped_before(const v1::WatchJobsResponse& message) {
  return message.has_watched() ? skipped_before(message.watched().event()) : 0;
}
template <class Message>
int skipped_before(const Message&) {
  return 0;
}

/// One open stream: sends the messages of its source one at a time, as fast as the client reads, and holds no thread.
/// It owns itself until gRPC is done with it. A Source is watch::JobSource, watch::SweepSource, DownloadSource,
/// FrameSource or HealthSource, or has the same members:
///   Message, kIsWatch   type of the messages; whether the metrics count it as a watch
///   open(wake), close   start and end of the calls to `wake` on changes
///   next, has_more      the next message, if there is one; whether it is available without waiting for the disk
///   ended               whether the last message was sent
///   bookmark            message to send after a long idle time; may be absent
///   resume_advice       how to continue a closed stream, as the end of a sentence
template <class Source>
class StreamReactor final : public grpc::ServerWriteReactor<typename Source::Message>, public watch::Pump::Task {
 public:
  using Message = typename Source::Message;

  /// Throws ServiceError (exhausted) if the caller, or all callers, have too many open streams.
  static grpc::ServerWriteReactor<Message>* start(const StreamParts& parts, grpc::CallbackServerContext& context,
                                                  const std::string& caller, std::unique_ptr<Source> source) {
    auto reactor = std::make_shared<StreamReactor>(parts, context, parts.limits.admit(caller), std::move(source));
    reactor->self_ = reactor;
    {
      // The pump may run the reactor while the source is being opened.
      const MutexLock lock(reactor->mutex_);
      reactor->source_->open([weak = std::weak_ptr<StreamReactor>(reactor)] {
        if (auto alive = weak.lock()) alive->wake(alive);
      });
    }
    parts.pump.add(reactor);
    return reactor.get();
  }

  StreamReactor(const StreamParts& parts, grpc::CallbackServerContext& context, StreamLimits::Permit permit,
                std::unique_ptr<Source> source)
      : parts_(parts), context_(context), permit_(std::move(permit)), source_(std::move(source)) {
    if (Source::kIsWatch) parts_.metrics.count_watcher(1);
  }

  void run() override {
    Action action = Action::none;
    // Messages that follow at once are sent together. Not the first: gRPC 1.51 completes the write of the initial
    // metadata, which go with it, only once they have been sent.
    grpc::WriteOptions options;
    {
      const MutexLock lock(mutex_);
      action = decide();
      if (action == Action::write && std::exchange(begun_, true) && source_->has_more()) options.set_buffer_hint();
    }
    switch (action) {
      case Action::none: return;
      case Action::write:
        report_to_metrics();
        this->StartWrite(&message_, options);
        return;
      case Action::finish: this->Finish(status_); return;
      case Action::abandon: abandon(); return;
    }
  }

  void OnWriteDone(bool ok) override {
    bool at_once = false;
    {
      const MutexLock lock(mutex_);
      writing_ = false;
      if (!ok) cancelled_ = true;
      at_once = source_->has_more();
    }
    // The pump's threads read the disk, not gRPC's.
    at_once ? run() : parts_.pump.schedule(self_);
  }

  void OnCancel() override {
    {
      const MutexLock lock(mutex_);
      cancelled_ = true;
    }
    parts_.pump.schedule(self_);
  }

  void OnDone() override {
    {
      // The pump may still run the reactor for a moment, but the objects of the call are gone. gRPC may call this from
      // within TryCancel, on the same thread.
      MutexLock lock(mutex_);
      done_ = true;
      abandoned_.wait(lock, [this]() CELLCRUSH_REQUIRES(mutex_) {
        return abandoning_ == std::thread::id() || abandoning_ == std::this_thread::get_id();
      });
      source_->close();
    }
    if (Source::kIsWatch) parts_.metrics.count_watcher(-1);
    // The last reference is `self`, or the pump's if it still holds one.
    const auto self = std::move(self_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The next action. Decided under the lock and performed without it, because gRPC may call back at once.
  enum class Action { none, write, finish, abandon };

  Action decide() CELLCRUSH_REQUIRES(mutex_) {
    if (done_) return Action::none;
    if (finished_) return is_to_be_abandoned() ? Action::abandon : Action::none;
    if (writing_) return is_stuck() ? close(status_of_stuck()) : Action::none;
    if (cancelled_) return close({grpc::StatusCode::CANCELLED, "The client cancelled the stream."});
    try {
      auto next = source_->next();
      if (!next && source_->ended()) return close(grpc::Status::OK);
      if (!next && parts_.pump.draining()) {
        return close({grpc::StatusCode::UNAVAILABLE,
                      "The daemon is shutting down. Ask again " + source_->resume_advice() + " after it restarts."});
      }
      if (!next && Clock::now() - last_write_ >= parts_.times.bookmark_interval) next = source_->bookmark();
      if (!next) return Action::none;
      permit_.hold(next->ByteSizeLong());
      message_ = *std::move(next);
    } catch (const std::exception& error) {
      return close(status_of(error));
    }
    writing_ = true;
    last_write_ = Clock::now();
    return Action::write;
  }

  /// Whether the client has left a message unread for too long. The status waits behind that message, for a client that
  /// soon resumes reading.
  [[nodiscard]] bool is_stuck() const CELLCRUSH_REQUIRES(mutex_) {
    return Clock::now() - last_write_ > parts_.times.patience;
  }

  /// Whether the client has not read the status either. Everything kept for it is then dropped, and it sees CANCELLED.
  [[nodiscard]] bool is_to_be_abandoned() CELLCRUSH_REQUIRES(mutex_) {
    if (!writing_ || abandoning_ != std::thread::id()) return false;
    if (Clock::now() - last_write_ <= parts_.times.patience + parts_.times.grace) return false;
    abandoning_ = std::this_thread::get_id();
    return true;
  }

  /// Without the lock: gRPC may call back at once.
  void abandon() {
    context_.TryCancel();
    {
      const MutexLock lock(mutex_);
      abandoning_ = std::thread::id();
    }
    abandoned_.notify_all();
  }

  [[nodiscard]] grpc::Status status_of_stuck() const CELLCRUSH_REQUIRES(mutex_) {
    const auto seconds = std::chrono::duration<double>(parts_.times.patience).count();
    return {grpc::StatusCode::RESOURCE_EXHAUSTED, "The client read nothing from this stream for " +
                                                      jobs::text_of(seconds) +
                                                      " s, so the stream was closed. Ask again " +
                                                      source_->resume_advice() + ", and read messages without delay."};
  }

  /// Something may have changed.
  void wake(const std::shared_ptr<StreamReactor>& self) {
    std::int64_t none = 0;
    pending_since_.compare_exchange_strong(none, Clock::now().time_since_epoch().count());
    parts_.pump.schedule(self);
  }

  void report_to_metrics() {
    if (const int skipped = skipped_before(message_); skipped > 0) parts_.metrics.count_skipped_frames(skipped);
    if (const std::int64_t since = pending_since_.exchange(0); since != 0) {
      const Clock::duration taken = Clock::now().time_since_epoch() - Clock::duration(since);
      parts_.metrics.observe_event(std::chrono::duration<double>(taken).count());
    }
  }

  Action close(grpc::Status status) CELLCRUSH_REQUIRES(mutex_) {
    status_ = std::move(status);
    finished_ = true;
    return Action::finish;
  }

  StreamParts parts_;
  grpc::CallbackServerContext& context_;  ///< valid until OnDone
  std::shared_ptr<StreamReactor> self_;
  /// Clock's count at the first event without a message yet; 0: none.
  std::atomic<std::int64_t> pending_since_ = 0;

  Mutex mutex_;
  StreamLimits::Permit permit_ CELLCRUSH_GUARDED_BY(mutex_);
  std::unique_ptr<Source> source_ CELLCRUSH_GUARDED_BY(mutex_);
  Message message_;                                  ///< built under the mutex; owned by gRPC while writing_
  grpc::Status status_;                              ///< likewise while finished_
  bool begun_ CELLCRUSH_GUARDED_BY(mutex_) = false;  ///< the first message was written
  bool writing_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  bool finished_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  bool cancelled_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::thread::id abandoning_ CELLCRUSH_GUARDED_BY(mutex_);  ///< the thread in TryCancel, while it is there
  std::condition_variable_any abandoned_;
  bool done_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  Clock::time_point last_write_ CELLCRUSH_GUARDED_BY(mutex_) = Clock::now();
};

/// Opens a stream of the source that `make` returns, for the caller that `name_caller` returns. If either throws, the
/// stream ends with its error.
template <class Source, class NameCaller, class Make>
grpc::ServerWriteReactor<typename Source::Message>* open_stream(const StreamParts& parts,
                                                                grpc::CallbackServerContext& context,
                                                                const NameCaller& name_caller, const Make& make) {
  try {
    return StreamReactor<Source>::start(parts, context, name_caller(), make());
  } catch (const std::exception& error) {
    return new RefusedStream<grpc::ServerWriteReactor<typename Source::Message>>(status_of(error));
  }
}

}  // namespace cellcrush::rpc
