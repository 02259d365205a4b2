#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "mutex.h"

namespace cellcrush::rpc {

/// Answers unary calls on a few threads of its own, in the order in which they come, so that any number of clients may
/// call at the same time. Thread-safe.
class CallPool {
 public:
  struct Most {
    int threads = 0;
    std::size_t waiting = 0;  ///< calls beyond those that run
    std::int64_t bytes = 0;   ///< of the requests that wait
  };

  explicit CallPool(Most most);
  /// Answers what still waits. REQUIRES: no call comes any more.
  ~CallPool();
  CallPool(const CallPool&) = delete;
  CallPool& operator=(const CallPool&) = delete;

  /// Calls `body` on a thread of the pool and ends the call with the status that it gives, or with that of what it
  /// throws. What `body` uses of the call is there until then. A call that is cancelled while it waits is left out; one
  /// beyond the limits ends with RESOURCE_EXHAUSTED.
  grpc::ServerUnaryReactor* run(grpc::CallbackServerContext& context, const google::protobuf::Message& request,
                                std::function<grpc::Status()> body);

 private:
  struct Call {
    grpc::CallbackServerContext* context = nullptr;
    grpc::ServerUnaryReactor* reactor = nullptr;
    std::int64_t bytes = 0;
    std::function<grpc::Status()> body;
  };

  void serve();
  /// Why the call is not taken; OK when it is.
  grpc::Status take(Call call);

  const Most most_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Call> waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  std::int64_t bytes_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< of waiting_
  bool ending_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> threads_;
};

}  // namespace cellcrush::rpc
