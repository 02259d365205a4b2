#include "rpc/open_calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "access/call_backlog.h"
#include "error.h"
#include "rpc/request_fields.h"

namespace cellcrush::rpc {
namespace {

// Is asked for a context for each call that gRPC queues, and leaves it to gRPC to make one.
class CallContexts final : public grpc::ContextAllocator {
 public:
  explicit CallContexts(access::Gate& gate) : gate_(gate) {}

  grpc::CallbackServerContext* NewCallbackServerContext() override {
    gate_.backlog().queue();
    return nullptr;
  }
  grpc::GenericCallbackServerContext* NewGenericCallbackServerContext() override {
    gate_.backlog().queue();
    return nullptr;
  }
  void Release(grpc::CallbackServerContext* context) override {
    gate_.backlog().end(gate_.key_of(*context->auth_context()));
  }
  void Release(grpc::GenericCallbackServerContext* context) override {
    Release(static_cast<grpc::CallbackServerContext*>(context));
  }

 private:
  access::Gate& gate_;
};

}  // namespace

OpenCalls::OpenCalls(Accounts& received) : received_(received) {
  received_.on_release([this] { read_more(); });
}

OpenCalls::Lines::iterator OpenCalls::line_of(const std::string& caller) {
  return std::ranges::find(lines_, caller, &Line::caller);
}

void OpenCalls::add(const std::shared_ptr<Call>& call, std::size_t most) {
  std::shared_ptr<Accounts::Charge> room;
  {
    const MutexLock lock(mutex_);
    auto line = line_of(call->caller_);
    if (line != lines_.end() && line->waiting.size() >= most) {
      throw ServiceError(ServiceError::Kind::exhausted,
                         fmt::format("{} calls of {} wait for their requests to come, the most of one caller. Send the "
                                     "requests of open calls first, and try again later.",
                                     most, call->caller_));
    }
    ++waiting_;  // before it looks for room, so that nobody who makes room misses it
    if (line == lines_.end()) room = received_.take(call->caller_, kLargestMessage);
    if (room) {
      --waiting_;
    } else {
      if (line == lines_.end()) line = lines_.insert(line, Line{call->caller_});
      line->waiting.push_back(call.get());
      call->waits_ = true;
    }
    calls_.emplace(call.get(), call);
  }
  if (room) call->read(std::move(room));
}

void OpenCalls::leave(Lines::iterator line, Call& call) {
  std::erase(line->waiting, &call);
  call.waits_ = false;
  --waiting_;
  if (line->waiting.empty()) {
    lines_.erase(line);
  } else {
    lines_.splice(lines_.end(), lines_, line);
  }
}

void OpenCalls::read_more() {
  if (waiting_ == 0) return;
  std::vector<std::pair<std::shared_ptr<Call>, std::shared_ptr<Accounts::Charge>>> next;
  {
    const MutexLock lock(mutex_);
    for (std::size_t without = 0; without < lines_.size();) {
      const auto line = lines_.begin();
      auto room = received_.take(line->caller, kLargestMessage);
      if (room) {
        Call& call = *line->waiting.front();
        next.emplace_back(calls_.at(&call), std::move(room));
        leave(line, call);
        without = 0;
      } else {
        lines_.splice(lines_.end(), lines_, line);
        ++without;
      }
    }
  }
  for (auto& [call, room] : next) call->read(std::move(room));
}

bool OpenCalls::withdraw(Call& call) {
  const MutexLock lock(mutex_);
  if (!call.waits_) return false;
  leave(line_of(call.caller_), call);
  return true;
}

void OpenCalls::remove(const Call& call) {
  std::shared_ptr<Call> own;  // whose end may make room
  const MutexLock lock(mutex_);
  const auto found = calls_.find(&call);
  own.swap(found->second);
  calls_.erase(found);
  if (calls_.empty()) none_.notify_all();
}

void OpenCalls::look() {
  std::vector<std::shared_ptr<Call>> late;
  {
    const MutexLock lock(mutex_);
    for (const auto& [key, call] : calls_) {
      if (call->is_due()) late.push_back(call);
    }
  }
  for (const auto& call : late) call->end_late();
}

void OpenCalls::wait_until_none(std::chrono::milliseconds longest) {
  MutexLock lock(mutex_);
  none_.wait_for(lock, longest, [this]() CELLCRUSH_REQUIRES(mutex_) { return calls_.empty(); });
}

void count_calls(grpc::ServerBuilder& builder, access::Gate& gate) {
  builder.SetContextAllocator(std::make_unique<CallContexts>(gate));
}

}  // namespace cellcrush::rpc
