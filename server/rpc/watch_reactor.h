#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

#include "cellcrush/v1/event.pb.h"
#include "cellcrush/v1/sweeps_service.pb.h"
#include "jobs/case_field.h"
#include "metrics/metrics.h"
#include "rpc/error_table.h"
#include "watch/pump.h"
#include "watch/watch_times.h"

namespace cellcrush::rpc {

/// What watches work with; all of it outlives them.
struct WatchParts {
  watch::Pump& pump;
  metrics::Metrics& metrics;
  watch::WatchTimes times;
};

/// Frames that were left out before this message.
inline int skipped_before(const v1::JobEvent& event) { return event.has_frame() ? event.frame().skipped() : 0; }
inline int skipped_before(const v1::WatchSweepResponse&) { return 0; }

/// One open watch: moves messages from its source to the stream, one at a time, as fast as the client takes them. It
/// keeps itself until gRPC is done with it. Source is watch::JobSource or watch::SweepSource, or has the same members.
template <class Source>
class WatchReactor final : public grpc::ServerWriteReactor<typename Source::Message>, public watch::Pump::Task {
 public:
  using Message = typename Source::Message;

  static grpc::ServerWriteReactor<Message>* start(const WatchParts& parts, std::unique_ptr<Source> source) {
    auto reactor = std::make_shared<WatchReactor>(parts, std::move(source));
    reactor->self_ = reactor;
    {
      // The pump may run the reactor while the source is being opened.
      const std::scoped_lock lock(reactor->mutex_);
      reactor->source_->open([weak = std::weak_ptr<WatchReactor>(reactor)] {
        if (auto alive = weak.lock()) alive->wake(alive);
      });
    }
    parts.pump.add(reactor);
    return reactor.get();
  }

  WatchReactor(const WatchParts& parts, std::unique_ptr<Source> source) : parts_(parts), source_(std::move(source)) {
    parts_.metrics.count_watcher(1);
  }

  void run() override {
    Action action = Action::none;
    // What is followed at once goes out together with what follows.
    grpc::WriteOptions options;
    {
      const std::scoped_lock lock(mutex_);
      action = decide();
      if (action == Action::write && source_->has_more()) options.set_buffer_hint();
    }
    if (action == Action::write) {
      tell_metrics();
      this->StartWrite(&message_, options);
    }
    if (action == Action::finish) this->Finish(status_);
  }

  void OnWriteDone(bool ok) override {
    bool at_once = false;
    {
      const std::scoped_lock lock(mutex_);
      writing_ = false;
      if (!ok) cancelled_ = true;
      at_once = source_->has_more();
    }
    // The journal is read by the pump's threads and not by those of gRPC.
    at_once ? run() : parts_.pump.schedule(self_);
  }

  void OnCancel() override {
    {
      const std::scoped_lock lock(mutex_);
      cancelled_ = true;
    }
    parts_.pump.schedule(self_);
  }

  void OnDone() override {
    source_->close();
    parts_.metrics.count_watcher(-1);
    // The last reference goes with `self`, or with the pump if it still holds one.
    const auto self = std::move(self_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// What to do next; decided under the lock, done without it, because gRPC may answer at once.
  enum class Action { none, write, finish };

  Action decide() {
    if (finished_) return Action::none;
    if (writing_) return is_stuck() ? close(status_of_stuck()) : Action::none;
    if (cancelled_) return close({grpc::StatusCode::CANCELLED, "The watcher is gone."});
    try {
      auto next = source_->next();
      if (!next && source_->ended()) return close(grpc::Status::OK);
      if (!next && parts_.pump.draining()) {
        return close({grpc::StatusCode::UNAVAILABLE,
                      "The daemon ends. Watch again " + source_->resume_advice() + " once it is back."});
      }
      if (!next && Clock::now() - last_write_ >= parts_.times.bookmark_interval) next = source_->bookmark();
      if (!next) return Action::none;
      message_ = *std::move(next);
    } catch (const std::exception& error) {
      return close(status_of(error));
    }
    writing_ = true;
    last_write_ = Clock::now();
    return Action::write;
  }

  /// Whether the client has let a message lie for too long. The status waits behind it, for a client that reads on.
  [[nodiscard]] bool is_stuck() const { return Clock::now() - last_write_ > parts_.times.patience; }

  [[nodiscard]] grpc::Status status_of_stuck() const {
    const auto seconds = std::chrono::duration<double>(parts_.times.patience).count();
    return {grpc::StatusCode::RESOURCE_EXHAUSTED, "Nothing of this watch was read for " + jobs::text_of(seconds) +
                                                      " s, so it was closed. Watch again " + source_->resume_advice() +
                                                      ", and read events as they come."};
  }

  /// There is news.
  void wake(const std::shared_ptr<WatchReactor>& self) {
    std::int64_t none = 0;
    news_since_.compare_exchange_strong(none, Clock::now().time_since_epoch().count());
    parts_.pump.schedule(self);
  }

  void tell_metrics() {
    if (const int skipped = skipped_before(message_); skipped > 0) parts_.metrics.count_skipped_frames(skipped);
    if (const std::int64_t since = news_since_.exchange(0); since != 0) {
      const Clock::duration taken = Clock::now().time_since_epoch() - Clock::duration(since);
      parts_.metrics.observe_event(std::chrono::duration<double>(taken).count());
    }
  }

  Action close(grpc::Status status) {
    status_ = std::move(status);
    finished_ = true;
    return Action::finish;
  }

  WatchParts parts_;
  std::shared_ptr<WatchReactor> self_;
  std::atomic<std::int64_t> news_since_ =
      0;  ///< Clock's count when the news came that no message was sent for; 0: there is none

  std::mutex mutex_;                ///< guards all below
  std::unique_ptr<Source> source_;  ///< close is called without it, when nothing else is any more
  Message message_;                 ///< in the hands of gRPC while writing_
  grpc::Status status_;
  bool writing_ = false;
  bool finished_ = false;
  bool cancelled_ = false;
  Clock::time_point last_write_ = Clock::now();
};

/// A watch that is refused before it begins.
template <class Message>
class RefusedWatch final : public grpc::ServerWriteReactor<Message> {
 public:
  explicit RefusedWatch(const grpc::Status& status) { this->Finish(status); }
  void OnDone() override { delete this; }
};

}  // namespace cellcrush::rpc
