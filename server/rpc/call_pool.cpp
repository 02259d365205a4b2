#include "rpc/call_pool.h"

#include <fmt/format.h>

#include <utility>

#include "error.h"
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

grpc::ServerUnaryReactor* CallPool::run(grpc::CallbackServerContext& context, const google::protobuf::Message& request,
                                        std::function<grpc::Status()> body) {
  auto* reactor = context.DefaultReactor();
  const auto bytes = static_cast<std::int64_t>(request.ByteSizeLong());
  if (const auto refusal = take({&context, reactor, bytes, std::move(body)}); !refusal.ok()) reactor->Finish(refusal);
  return reactor;
}

grpc::Status CallPool::take(Call call) {
  {
    const MutexLock lock(mutex_);
    // A single call may always wait.
    if (waiting_.size() >= most_.waiting || (bytes_ > 0 && bytes_ + call.bytes > most_.bytes)) {
      return {grpc::StatusCode::RESOURCE_EXHAUSTED,
              fmt::format(
                  "{} calls with {} bytes are waiting to be answered, which is the daemon's limit. Try again later.",
                  waiting_.size(), bytes_)};
    }
    bytes_ += call.bytes;
    waiting_.push_back(std::move(call));
  }
  changed_.notify_one();
  return grpc::Status::OK;
}

void CallPool::serve() {
  for (;;) {
    Call call;
    {
      MutexLock lock(mutex_);
      changed_.wait(lock, [this]() CELLCRUSH_REQUIRES(mutex_) { return ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      call = std::move(waiting_.front());
      waiting_.pop_front();
      bytes_ -= call.bytes;
    }
    call.reactor->Finish(call.context->IsCancelled()
                             ? grpc::Status(grpc::StatusCode::CANCELLED, "The client cancelled the call.")
                             : answer(call.body));
  }
}

}  // namespace cellcrush::rpc
