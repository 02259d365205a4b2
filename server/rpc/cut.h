#pragma once

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <thread>

#include "mutex.h"

namespace cellcrush::rpc {

/// Cancels a call of gRPC, whose context is valid until OnDone, while OnDone may come on another thread. Thread-safe.
class Cut {
 public:
  /// Cancels the call unless gRPC is done with it. gRPC may call OnCancel and OnDone from within, on this thread.
  void cancel(const grpc::CallbackServerContext& context) {
    {
      const MutexLock lock(mutex_);
      if (is_done_ || canceller_ != std::thread::id()) return;
      canceller_ = std::this_thread::get_id();
    }
    context.TryCancel();
    {
      const MutexLock lock(mutex_);
      canceller_ = std::thread::id();
    }
    ended_.notify_all();
  }

  /// OnDone calls this first: returns once no other thread uses the context.
  void end() {
    MutexLock lock(mutex_);
    is_done_ = true;
    ended_.wait(lock, [this]() CELLCRUSH_REQUIRES(mutex_) {
      return canceller_ == std::thread::id() || canceller_ == std::this_thread::get_id();
    });
  }

 private:
  Mutex mutex_;
  std::thread::id canceller_ CELLCRUSH_GUARDED_BY(mutex_);  ///< the thread in TryCancel, while it is there
  bool is_done_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::condition_variable_any ended_;
};

}  // namespace cellcrush::rpc
