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

/// Answers unary calls on a few threads of its own, in order of arrival, so that any number of clients may call at
/// once. Thread-safe.
class CallPool {
 public:
  struct Most {
    int threads = 0;
    std::size_t waiting = 0;  ///< calls beyond the running ones
    std::int64_t bytes = 0;   ///< requests of waiting calls
  };

  explicit CallPool(Most most);
  /// Answers the waiting calls. REQUIRES: no further calls arrive.
  ~CallPool();
  CallPool(const CallPool&) = delete;
  CallPool& operator=(const CallPool&) = delete;

  /// Runs `body` on a thread of the pool, and ends the call with the status it returns or that of its exception. The
  /// objects of the call live until then. A call cancelled while waiting is skipped; one beyond the limits ends with
  /// RESOURCE_EXHAUSTED.
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
  /// Why the call is refused; OK if it is not.
  grpc::Status take(Call call);

  const Most most_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Call> waiting_ CELLCRUSH_GUARDED_BY(mutex_);
  std::int64_t bytes_ CELLCRUSH_GUARDED_BY(mutex_) = 0;  ///< of the calls in waiting_
  bool ending_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::vector<std::jthread> threads_;
};

}  // namespace cellcrush::rpc
