#pragma once

#include <grpcpp/support/status.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "access/token_file.h"
#include "error.h"
#include "mutex.h"

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

/// Answers unary calls on a few threads of its own, in order of arrival, so that any number of clients may call at
/// once. Thread-safe.
class CallPool {
 public:
  struct Most {
    int threads = 0;
    std::size_t waiting = 0;  ///< calls beyond the running ones
    std::int64_t bytes = 0;   ///< requests of waiting calls
  };

  struct Task {
    std::shared_ptr<const Call> call;
    std::int64_t bytes = 0;  ///< of the request
    std::function<void()> body;
    std::function<void(const grpc::Status&)> finish;
  };

  explicit CallPool(Most most);
  /// Answers the waiting calls. REQUIRES: no further calls arrive.
  ~CallPool();
  CallPool(const CallPool&) = delete;
  CallPool& operator=(const CallPool&) = delete;

  /// Runs the body on a thread of the pool and finishes with OK, or the status of its exception. A call cancelled while
  /// waiting is skipped; one beyond the limits ends with RESOURCE_EXHAUSTED.
  void run(Task task);

 private:
  void serve();
  /// Why the task is refused; OK, and the task is taken, if it is not.
  grpc::Status take(Task& task);

  const Most most_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Task> waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  std::int64_t bytes_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< of the tasks in waiting_
  bool ending_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> threads_;
};

}  // namespace cellcrush::rpc
