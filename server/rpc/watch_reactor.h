#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <utility>

#include "rpc/error_table.h"
#include "watch/pump.h"

namespace cellcrush::rpc {

/// One open watch: moves messages from its source to the stream, one at a time, as fast as the client takes them. It
/// keeps itself until gRPC is done with it. Source is watch::JobSource or watch::SweepSource, or has the same members.
template <class Source>
class WatchReactor final : public grpc::ServerWriteReactor<typename Source::Message>, public watch::Pump::Task {
 public:
  using Message = typename Source::Message;

  static grpc::ServerWriteReactor<Message>* start(watch::Pump& pump, std::chrono::milliseconds bookmark_interval,
                                                  std::unique_ptr<Source> source) {
    auto reactor = std::make_shared<WatchReactor>(pump, bookmark_interval, std::move(source));
    reactor->self_ = reactor;
    {
      // The pump may run the reactor while the source is being opened.
      const std::scoped_lock lock(reactor->mutex_);
      reactor->source_->open([&pump, weak = std::weak_ptr<WatchReactor>(reactor)] {
        if (auto alive = weak.lock()) pump.schedule(alive);
      });
    }
    pump.add(reactor);
    return reactor.get();
  }

  WatchReactor(watch::Pump& pump, std::chrono::milliseconds bookmark_interval, std::unique_ptr<Source> source)
      : pump_(pump), bookmark_interval_(bookmark_interval), source_(std::move(source)) {}

  void run() override {
    Action action = Action::none;
    {
      const std::scoped_lock lock(mutex_);
      action = decide();
    }
    if (action == Action::write) this->StartWrite(&message_);
    if (action == Action::finish) this->Finish(status_);
  }

  void OnWriteDone(bool ok) override {
    {
      const std::scoped_lock lock(mutex_);
      writing_ = false;
      if (!ok) cancelled_ = true;
    }
    pump_.schedule(self_);
  }

  void OnCancel() override {
    {
      const std::scoped_lock lock(mutex_);
      cancelled_ = true;
    }
    pump_.schedule(self_);
  }

  void OnDone() override {
    source_->close();
    // The last reference goes with `self`, or with the pump if it still holds one.
    const auto self = std::move(self_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// What to do next; decided under the lock, done without it, because gRPC may answer at once.
  enum class Action { none, write, finish };

  Action decide() {
    if (writing_ || finished_) return Action::none;
    if (cancelled_) return close({grpc::StatusCode::CANCELLED, "The watcher is gone."});
    try {
      auto next = source_->next();
      if (!next && source_->ended()) return close(grpc::Status::OK);
      if (!next && pump_.draining()) {
        return close({grpc::StatusCode::UNAVAILABLE,
                      "The daemon ends. Watch again " + source_->resume_advice() + " once it is back."});
      }
      if (!next && Clock::now() - last_write_ >= bookmark_interval_) next = source_->bookmark();
      if (!next) return Action::none;
      message_ = *std::move(next);
    } catch (const std::exception& error) {
      return close(status_of(error));
    }
    writing_ = true;
    last_write_ = Clock::now();
    return Action::write;
  }

  Action close(grpc::Status status) {
    status_ = std::move(status);
    finished_ = true;
    return Action::finish;
  }

  watch::Pump& pump_;
  std::chrono::milliseconds bookmark_interval_;
  std::shared_ptr<WatchReactor> self_;

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
