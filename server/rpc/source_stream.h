#pragma once

#include <google/protobuf/message.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "mutex.h"
#include "rpc/accounts.h"
#include "rpc/stream_state.h"

namespace cellcrush::rpc {

/// The answers to one call that did not come over gRPC: those of a stream, or the only one of a unary call. It gives
/// encoded messages when it is asked for them, and so holds at most one batch. Thread-safe.
class MessageStream {
 public:
  virtual ~MessageStream() = default;

  /// Appends a message as it goes out. May throw ServiceError.
  using Encode = std::function<void(const google::protobuf::Message& message, std::string& to)>;
  /// Appends what goes before a message of that many bytes, which goes out as it is. Null: messages go out otherwise.
  using Begin = std::function<void(std::size_t bytes, std::string& to)>;

  /// Some messages, in order.
  struct Batch {
    std::string bytes;
    std::optional<grpc::Status> end;                     ///< how the stream ended; nothing follows
    std::shared_ptr<Accounts::Charge> charge = nullptr;  ///< for the bytes of a unary call, until they are sent
  };
  /// Called on the thread that made the batch, without a lock: must be quick.
  using Deliver = std::function<void(Batch batch)>;

  /// Asks for the next batch, which is delivered once there is one. REQUIRES: the batch before it was delivered.
  virtual void ask(Deliver deliver) = 0;

  /// Nobody waits for what follows. Quick; safe to repeat. A stream delivers nothing any more, except what is being
  /// delivered now; a unary call still ends with a batch.
  virtual void cancel() = 0;
};

/// A MessageStream of a source (stream_state.h). A thread of the pump opens the source, as that may read the disk.
template <class Source>
class SourceStream final : public MessageStream,
                           public watch::Pump::Task,
                           public std::enable_shared_from_this<SourceStream<Source>> {
 public:
  using Make = std::function<std::unique_ptr<Source>()>;

  /// If `make` throws, the stream ends with its error.
  SourceStream(const StreamParts& parts, std::string caller, Encode encode, Make make, Begin begin = nullptr)
      : Task(caller),
        parts_(parts),
        encode_(std::move(encode)),
        begin_(std::move(begin)),
        caller_(std::move(caller)),
        make_(std::move(make)) {}
  ~SourceStream() override {
    const MutexLock lock(mutex_);
    finish(cancelled());
  }

  void ask(Deliver deliver) override {
    bool is_first = false;
    {
      const MutexLock lock(mutex_);
      deliver_ = std::move(deliver);
      is_first = !std::exchange(is_known_, true);
    }
    is_first ? parts_.pump.add(this->shared_from_this()) : parts_.pump.schedule(this->shared_from_this());
  }

  // Waits for no batch that is being made.
  void cancel() override {
    is_cancelled_ = true;
    parts_.pump.schedule(this->shared_from_this());
  }

  void run() override {
    Deliver deliver;
    Batch batch;
    {
      const MutexLock lock(mutex_);
      if (is_cancelled_) return drop();
      if (!deliver_) return close_if_stuck();
      fill(batch);
      if (is_cancelled_) return drop();
      if (batch.bytes.empty() && !batch.end) return;
      deliver = std::exchange(deliver_, nullptr);
    }
    deliver(std::move(batch));
  }

 private:
  /// Messages up to this many bytes, and one more, are sent together.
  static constexpr std::size_t kBatchBytes = 64 * 1024;

  static grpc::Status cancelled() { return {grpc::StatusCode::CANCELLED, "The client cancelled the stream."}; }

  void drop() CELLCRUSH_REQUIRES(mutex_) {
    finish(cancelled());
    deliver_ = nullptr;
  }

  void fill(Batch& batch) CELLCRUSH_REQUIRES(mutex_) {
    std::size_t whole = 0;  // bytes of the messages that are encoded
    try {
      if (!status_ && !state_) open();
      if (state_) state_->end_write();
      while (!status_ && !is_cancelled_ && batch.bytes.size() < kBatchBytes) {
        const auto next = state_->next();
        if (!next) {
          if (state_->status()) finish(grpc::Status(*state_->status()));
          break;
        }
        append(*next, batch.bytes);
        whole = batch.bytes.size();
        state_->count_skipped(*next);
      }
      if (batch.bytes.empty()) {
        batch.end = status_;
        return;
      }
      delay_.end(parts_.metrics);
      if (!status_ && !state_->begin_write(batch.bytes.size())) {
        batch.bytes.clear();
        finish(grpc::Status(*state_->status()));
      }
    } catch (const std::exception& error) {
      batch.bytes.resize(whole);
      finish(status_of(error));
    }
    batch.end = status_;
  }

  void append(const google::protobuf::Message& message, std::string& to) { encode_(message, to); }
  void append(const watch::SentMessage& message, std::string& to) {
    if (!begin_) return encode_(message.parsed<typename Source::Message>(), to);
    begin_(message.size(), to);
    message.append_to(to);
  }

  void open() CELLCRUSH_REQUIRES(mutex_) {
    state_.emplace(parts_, caller_, std::exchange(make_, nullptr)());
    state_->open([weak = this->weak_from_this()] {
      const auto alive = weak.lock();
      if (!alive) return;
      alive->delay_.begin();
      alive->parts_.pump.wake(alive);
    });
  }

  /// The status waits behind the unread batch, for a client that resumes reading.
  void close_if_stuck() CELLCRUSH_REQUIRES(mutex_) {
    if (state_ && state_->is_stuck()) finish(state_->status_of_stuck());
  }

  /// Everything kept for the client is dropped.
  void finish(const grpc::Status& status) CELLCRUSH_REQUIRES(mutex_) {
    if (status_) return;
    status_ = status;
    if (state_) state_->close();
    state_.reset();
  }

  StreamParts parts_;
  Encode encode_;
  Begin begin_;
  EventDelay delay_;

  std::atomic<bool> is_cancelled_ = false;
  Mutex mutex_;
  std::string caller_;
  Make make_ CELLCRUSH_GUARDED_BY(mutex_);  ///< until the source is open
  std::optional<StreamState<Source>> state_ CELLCRUSH_GUARDED_BY(mutex_);
  std::optional<grpc::Status> status_ CELLCRUSH_GUARDED_BY(mutex_);  ///< once it has ended
  Deliver deliver_ CELLCRUSH_GUARDED_BY(mutex_);                     ///< null unless a batch is asked for
  bool is_known_ CELLCRUSH_GUARDED_BY(mutex_) = false;               ///< to the pump
};

}  // namespace cellcrush::rpc
