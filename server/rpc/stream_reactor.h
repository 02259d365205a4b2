#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "mutex.h"
#include "rpc/request_reactor.h"
#include "rpc/stream_state.h"

namespace cellcrush::rpc {

/// A stream that is refused before it starts. Reactor is a gRPC server reactor.
template <class Reactor>
class RefusedStream final : public Reactor {
 public:
  explicit RefusedStream(const grpc::Status& status) { this->Finish(status); }
  void OnDone() override { delete this; }
};

/// The bytes that gRPC sends for a message. Large ones that messages share are not copied.
grpc::ByteBuffer wire_of(const watch::SentMessage& message);
grpc::ByteBuffer wire_of(const google::protobuf::Message& message);

/// One open stream over gRPC: sends the messages of its source (stream_state.h) one at a time, as fast as the client
/// reads, and holds no thread.
template <class Source>
class StreamReactor final : public RequestReactor, public watch::Pump::Task {
 public:
  /// Returns the source that a request asks for. What it throws ends the stream.
  using Make = std::function<std::unique_ptr<Source>(grpc::ByteBuffer& request)>;

  /// The pump of `parts` advances it.
  StreamReactor(OpenCalls& open, const grpc::CallbackServerContext& context, const std::string& caller,
                Patience patience, const StreamParts& parts, Make make)
      : RequestReactor(open, context, caller, patience), Task(caller), parts_(parts), make_(std::move(make)) {}

  void run() override {
    Action action = Action::none;
    // Messages that follow at once are sent together. Not the first: gRPC 1.51 completes the write of the initial
    // metadata, which go with it, only once they have been sent.
    grpc::WriteOptions options;
    {
      const MutexLock lock(mutex_);
      action = decide();
      if (action == Action::write && std::exchange(begun_, true) && state_->source().has_more())
        options.set_buffer_hint();
    }
    switch (action) {
      case Action::none: return;
      case Action::write: this->StartWrite(&message_, options); return;
      case Action::finish: note_end(status_), this->Finish(status_); return;
      case Action::abandon: cut(); return;
    }
  }

  void OnWriteDone(bool ok) override {
    bool at_once = false;
    {
      const MutexLock lock(mutex_);
      writing_ = false;
      if (!ok) cancelled_ = true;
      at_once = state_->source().has_more();
      if (!at_once && !cancelled_ && !finished_ && state_->is_quiet()) return;
    }
    // The pump's threads read the disk, not gRPC's.
    at_once ? run() : parts_.pump.schedule(self());
  }

  void OnCancel() override {
    RequestReactor::OnCancel();
    {
      const MutexLock lock(mutex_);
      cancelled_ = true;
      if (!state_) return;
    }
    parts_.pump.schedule(self());
  }

  void OnDone() override {
    {
      // The pump may still run the reactor for a moment, but the objects of the call are gone.
      const MutexLock lock(mutex_);
      done_ = true;
      if (state_) state_->close();
    }
    RequestReactor::OnDone();
  }

 private:
  void on_request(grpc::ByteBuffer& bytes, std::shared_ptr<Accounts::Charge>) override {
    try {
      auto source = make_(bytes);
      // The pump may run the reactor while the source is being opened.
      const MutexLock lock(mutex_);
      state_.emplace(parts_, caller_name(), std::move(source));
      state_->open([weak = std::weak_ptr<StreamReactor>(self())] {
        if (auto alive = weak.lock()) alive->wake(alive);
      });
    } catch (const std::exception& error) {
      {
        const MutexLock lock(mutex_);
        if (std::exchange(finished_, true)) return;
      }
      return end(status_of(error));
    }
    parts_.pump.add(self());
  }

  std::shared_ptr<StreamReactor> self() { return std::static_pointer_cast<StreamReactor>(shared_from_this()); }

  /// The next action. Decided under the lock and performed without it, because gRPC may call back at once.
  enum class Action { none, write, finish, abandon };

  Action decide() CELLCRUSH_REQUIRES(mutex_) {
    if (done_) return Action::none;
    // If the client has not read the status either, everything kept for it is dropped, and it sees CANCELLED.
    if (finished_) return writing_ && state_->is_to_be_abandoned() ? Action::abandon : Action::none;
    // The status waits behind the unread message, for a client that soon resumes reading.
    if (writing_) return state_->is_stuck() ? close(state_->status_of_stuck()) : Action::none;
    if (cancelled_) return close({grpc::StatusCode::CANCELLED, "The client cancelled the stream."});
    auto next = state_->next();
    if (!next && !state_->status()) return Action::none;
    if (!next) return close(*state_->status());
    message_ = wire_of(*next);
    if (!state_->begin_write(message_.Length())) return close(*state_->status());
    state_->count_skipped(*next);
    delay_.end(parts_.metrics);
    writing_ = true;
    return Action::write;
  }

  /// Something may have changed.
  void wake(const std::shared_ptr<StreamReactor>& self) {
    delay_.begin();
    parts_.pump.wake(self);
  }

  Action close(grpc::Status status) CELLCRUSH_REQUIRES(mutex_) {
    status_ = std::move(status);
    finished_ = true;
    return Action::finish;
  }

  StreamParts parts_;
  Make make_;
  EventDelay delay_;

  Mutex mutex_;
  std::optional<StreamState<Source>> state_ CELLCRUSH_GUARDED_BY(mutex_);  ///< once the request has come
  grpc::ByteBuffer message_;                         ///< built under the mutex; owned by gRPC while writing_
  grpc::Status status_;                              ///< likewise while finished_
  bool begun_ CELLCRUSH_GUARDED_BY(mutex_) = false;  ///< the first message was written
  bool writing_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  bool finished_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  bool cancelled_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  bool done_ CELLCRUSH_GUARDED_BY(mutex_) = false;
};

}  // namespace cellcrush::rpc
