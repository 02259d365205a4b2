#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "error_table.h"
#include "rpc/call_pool.h"

namespace cellcrush::rpc {

/// The long work of a stream before its first message, such as the check of a file's bytes, on a thread of a pool of
/// calls: the thread that serves all streams goes on meanwhile. Thread-safe.
class Preparation final : public Call, public std::enable_shared_from_this<Preparation> {
 public:
  explicit Preparation(std::string caller) : caller_{std::move(caller), access::Scope::read} {}

  /// Has `work` run; `wake` is called once it is done. `is_large`: whether it may take seconds.
  void begin(CallPool& pool, bool is_large, std::function<void(const Call& call)> work, std::function<void()> wake) {
    CallPool::Task task{.call = shared_from_this(), .caller = caller_.name, .is_large = is_large};
    task.body = [work = std::move(work)](CallPool::Task& own) { work(*own.call); };
    task.finish = [self = shared_from_this(), wake = std::move(wake)](const grpc::Status& status, auto) {
      self->status_ = status;
      self->is_done_ = true;
      wake();
    };
    pool.run(std::move(task));
  }

  /// Nobody waits for it any more.
  void cancel() { is_cancelled_ = true; }

  [[nodiscard]] bool is_done() const { return is_done_; }
  /// How it ended. REQUIRES: is_done().
  [[nodiscard]] const grpc::Status& status() const { return status_; }

  [[nodiscard]] access::Caller caller() const override { return caller_; }
  [[nodiscard]] bool is_cancelled() const override { return is_cancelled_; }

 private:
  access::Caller caller_;
  grpc::Status status_;
  std::atomic<bool> is_cancelled_ = false;
  std::atomic<bool> is_done_ = false;
};

}  // namespace cellcrush::rpc
