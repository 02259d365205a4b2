#pragma once

#include <grpcpp/server_builder.h>

#include <chrono>
#include <condition_variable>

#include "access/gate.h"
#include "mutex.h"

namespace cellcrush::rpc {

/// Counts the calls over gRPC that are not answered yet. Thread-safe.
class OpenCalls {
 public:
  void add();
  void remove();
  /// Returns once there is none, or after this time.
  void wait_until_none(std::chrono::milliseconds longest);

 private:
  Mutex mutex_;
  std::condition_variable_any none_;
  int count_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
};

/// Counts every call of the server in `open` and in the gate's backlog. Both outlive the server.
void count_calls(grpc::ServerBuilder& builder, OpenCalls& open, access::Gate& gate);

}  // namespace cellcrush::rpc
