#pragma once

#include <grpcpp/server_builder.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <list>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "access/gate.h"
#include "mutex.h"
#include "rpc/accounts.h"

namespace cellcrush::rpc {

/// The calls over gRPC that have begun and not ended. gRPC takes up to 4 MiB for a request that it reads, however
/// slowly that comes, and 64 kB for others: few are read at once, those of one caller within its account, the others
/// wait. Calls that are late are ended. Thread-safe.
class OpenCalls {
 public:
  using Clock = std::chrono::steady_clock;

  class Call {
   public:
    Call(std::string caller, Clock::time_point due) : caller_(std::move(caller)), due_(due) {}
    virtual ~Call() = default;
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    /// Has the request read. Called once. `room`: held for it, the most that a request takes.
    virtual void read(std::shared_ptr<Accounts::Charge> room) = 0;
    /// The call is due.
    virtual void end_late() = 0;

   protected:
    [[nodiscard]] const std::string& caller_name() const { return caller_; }
    void set_due(Clock::time_point due) { due_ = due; }
    [[nodiscard]] bool is_due() const { return due_.load() <= Clock::now(); }

   private:
    friend class OpenCalls;
    const std::string caller_;
    std::atomic<Clock::time_point> due_;
    bool waits_ = false;  ///< to be read; under the lock of OpenCalls
  };

  /// `received` outlives it.
  explicit OpenCalls(Accounts& received);

  /// Keeps the call until `remove`, and has it read in its turn. Throws ServiceError (exhausted) if more than `most` of
  /// its caller would wait.
  void add(const std::shared_ptr<Call>& call, std::size_t most);

  /// The call does not wait to be read any more. False if it did not.
  bool withdraw(Call& call);

  /// The call has ended. It may be destroyed.
  void remove(const Call& call);

  /// Called about once a second: ends what is late.
  void look();

  /// Returns once there is none, or after this time.
  void wait_until_none(std::chrono::milliseconds longest);

 private:
  struct Line {
    std::string caller;
    std::deque<Call*> waiting = {};
  };
  using Lines = std::list<Line>;

  /// Has those read for which there is room, callers in turn.
  void read_more();
  Lines::iterator line_of(const std::string& caller) CELLCRUSH_REQUIRES(mutex_);
  void leave(Lines::iterator line, Call& call) CELLCRUSH_REQUIRES(mutex_);

  Accounts& received_;
  Mutex mutex_;
  std::condition_variable_any none_;
  std::unordered_map<const Call*, std::shared_ptr<Call>> calls_ CELLCRUSH_GUARDED_BY(mutex_);
  Lines lines_ CELLCRUSH_GUARDED_BY(mutex_);  ///< of callers with calls that wait, the one whose turn it is first
  std::atomic<std::size_t> waiting_ = 0;      ///< calls of all callers; may count one more for a moment
};

/// Has gRPC tell the gate's backlog of each call that it has queued, and of its end. The gate outlives the server.
void count_calls(grpc::ServerBuilder& builder, access::Gate& gate);

}  // namespace cellcrush::rpc
