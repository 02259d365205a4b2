#include "rpc/call_pool.h"

#include <fmt/format.h>

#include <utility>

#include "error_table.h"

namespace cellcrush::rpc {

CallPool::CallPool(Most most) : most_(most) {
  for (int i = 0; i < most_.threads; ++i) threads_.emplace_back([this] { serve(); });
}

CallPool::~CallPool() {
  {
    const MutexLock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
}

void CallPool::run(Task task) {
  if (const auto refusal = take(task); !refusal.ok()) task.finish(refusal);
}

grpc::Status CallPool::take(Task& task) {
  {
    const MutexLock lock(mutex_);
    // A single call may always wait.
    if (waiting_.size() >= most_.waiting || (bytes_ > 0 && bytes_ + task.bytes > most_.bytes)) {
      return {grpc::StatusCode::RESOURCE_EXHAUSTED,
              fmt::format(
                  "{} calls with {} bytes are waiting to be answered, which is the daemon's limit. Try again later.",
                  waiting_.size(), bytes_)};
    }
    bytes_ += task.bytes;
    waiting_.push_back(std::move(task));
  }
  changed_.notify_one();
  return grpc::Status::OK;
}

void CallPool::serve() {
  for (;;) {
    Task task;
    {
      MutexLock lock(mutex_);
      changed_.wait(lock, [this]() CELLCRUSH_REQUIRES(mutex_) { return ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      task = std::move(waiting_.front());
      waiting_.pop_front();
      bytes_ -= task.bytes;
    }
    task.finish(answer([&task] {
      task.call->require_wanted();
      task.body();
    }));
  }
}

}  // namespace cellcrush::rpc
