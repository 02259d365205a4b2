#pragma once

#include <grpcpp/support/status.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "access/token_file.h"
#include "error.h"
#include "mutex.h"
#include "rpc/accounts.h"

namespace cellcrush::rpc {

/// An admitted call as its handler sees it, whichever way it came. Thread-safe.
class Call {
 public:
  virtual ~Call() = default;

  /// Throws ServiceError (unauthenticated) if the credentials are no longer known.
  [[nodiscard]] virtual access::Caller caller() const = 0;

  /// Whether nobody waits for the answer any more: the client is gone, or its time is over.
  [[nodiscard]] virtual bool is_cancelled() const = 0;

  /// Throws ServiceError (cancelled) if nobody does.
  void require_wanted() const {
    if (is_cancelled()) throw ServiceError(ServiceError::Kind::cancelled, "The client cancelled the call.");
  }
};

/// Answers unary calls on a few threads of its own, so that any number of clients may call at once. The callers take
/// turns, each with as many threads and as much memory as it may have; the calls of one come in order of arrival, but
/// small ones do not wait for large ones. Thread-safe.
class CallPool {
 public:
  struct Most {
    int threads = 0;
    int threads_per_caller = 0;
    int large = 0;  ///< large calls at once
    int large_per_caller = 0;
    std::size_t waiting_per_caller = 0;  ///< calls beyond the running ones
  };

  struct Task {
    std::shared_ptr<const Call> call;  ///< null for work of the daemon
    std::string caller;      ///< for whom it counts
    std::int64_t bytes = 0;  ///< memory that it may take
    bool is_large = false;   ///< may take seconds
    /// May move the task on to another pool; it then is not finished here.
    std::function<void(Task& task)> body = nullptr;
    /// Null: nobody is told.
    std::function<void(const grpc::Status& status, std::shared_ptr<Accounts::Charge> charge)> finish = nullptr;
    std::shared_ptr<Accounts::Charge> charge = nullptr;  ///< for the memory; the pool takes one before the body runs
  };

  /// `memory` outlives the pool.
  CallPool(Most most, Accounts& memory);
  ~CallPool() { stop(); }
  CallPool(const CallPool&) = delete;
  CallPool& operator=(const CallPool&) = delete;

  /// Answers the waiting calls, and ends the threads. REQUIRES: no further calls arrive. Safe to repeat.
  void stop();

  /// Runs the body on a thread of the pool and finishes with OK, or the status of its exception. A call cancelled while
  /// waiting is skipped; one beyond the limits ends with RESOURCE_EXHAUSTED.
  void run(Task task);

  /// Runs work of the daemon in its turn.
  void post(std::function<void()> work);

  /// Runs the body on this thread and finishes, if the caller has memory for it; otherwise the task is as before.
  bool run_at_once(Task& task);

  /// Runs the body, on this thread, and finishes.
  static void run_here(Task task);

 private:
  /// The calls of one caller.
  struct Line {
    std::string caller;
    std::deque<Task> waiting = {};
    int running = 0;
    int large_running = 0;
  };
  using Lines = std::list<Line>;

  void serve();
  /// The next call that may run, and moves its caller to the end of the line; null if there is none.
  std::optional<Task> next() CELLCRUSH_REQUIRES(mutex_);
  [[nodiscard]] bool may_run(const Line& line, const Task& task) const CELLCRUSH_REQUIRES(mutex_);
  Line& line_of(const std::string& caller) CELLCRUSH_REQUIRES(mutex_);
  void end(const std::string& caller, bool is_large);
  void wake_if_waiting() CELLCRUSH_REQUIRES(mutex_);

  const Most most_;
  Accounts& memory_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  Lines lines_ CELLCRUSH_GUARDED_BY(mutex_);              ///< those with calls, the one whose turn it is first
  std::size_t waiting_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< calls of all callers
  int large_running_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
  bool ending_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> threads_;
};

}  // namespace cellcrush::rpc
