#include "rpc/call_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "error_table.h"

namespace cellcrush::rpc {
namespace {

constexpr std::chrono::seconds kBetweenLooks{1};

}  // namespace

CallPool::CallPool(Most most, Accounts& memory) : most_(most), memory_(memory) {
  memory_.on_release([this] {
    const MutexLock lock(mutex_);
    wake_if_waiting();
  });
  for (int i = 0; i < most_.threads; ++i) threads_.emplace_back([this] { serve(); });
}

void CallPool::stop() {
  {
    const MutexLock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  threads_.clear();
}

void CallPool::run(Task task) {
  grpc::Status refusal;
  {
    const MutexLock lock(mutex_);
    Line& line = line_of(task.caller);
    if (line.waiting.size() < most_.waiting_per_caller) {
      line.waiting.push_back(std::move(task));
      ++waiting_;
      // Otherwise a thread that answers this caller runs it next.
      if (line.running < most_.threads_per_caller) changed_.notify_one();
      return;
    }
    refusal = {grpc::StatusCode::RESOURCE_EXHAUSTED,
               fmt::format("{} calls of {} are waiting to be answered, the most of one caller. Try again later.",
                           line.waiting.size(), task.caller)};
  }
  if (task.finish) task.finish(refusal, nullptr);
}

void CallPool::post(std::function<void()> work) {
  run({.call = nullptr, .caller = "the daemon", .body = [work = std::move(work)](Task&) { work(); }});
}

bool CallPool::run_at_once(Task& task) {
  task.charge = memory_.take(task.caller, task.bytes);
  if (!task.charge) return false;
  run_here(std::move(task));
  return true;
}

void CallPool::run_here(Task task) {
  const auto body = std::exchange(task.body, nullptr);  // which may give the task another
  const auto status = answer([&] {
    if (task.call) task.call->require_wanted();
    body(task);
  });
  if (task.finish) task.finish(status, std::move(task.charge));
}

CallPool::Line& CallPool::line_of(const std::string& caller) {
  const auto found = std::ranges::find(lines_, caller, &Line::caller);
  return found != lines_.end() ? *found : lines_.emplace_back(Line{caller});
}

bool CallPool::may_run(const Line& line, const Task& task) const {
  return line.running < most_.threads_per_caller &&
         (!task.is_large || (large_running_ < most_.large && line.large_running < most_.large_per_caller));
}

std::optional<CallPool::Task> CallPool::next() {
  for (auto line = lines_.begin(); line != lines_.end(); ++line) {
    const auto task = std::ranges::find_if(line->waiting, [&](const Task& each) CELLCRUSH_REQUIRES(mutex_) {
      return may_run(*line, each);
    });
    if (task == line->waiting.end()) continue;
    if (!task->charge) task->charge = memory_.take(line->caller, task->bytes);
    if (!task->charge && (ending_ || (task->call && task->call->is_cancelled())))
      task->charge = std::make_shared<Accounts::Charge>(memory_, line->caller, 0);
    if (!task->charge) continue;
    auto out = std::move(*task);
    line->waiting.erase(task);
    --waiting_;
    wake_if_waiting();
    ++line->running;
    line->large_running += out.is_large ? 1 : 0;
    large_running_ += out.is_large ? 1 : 0;
    lines_.splice(lines_.end(), lines_, line);
    return out;
  }
  return std::nullopt;
}

void CallPool::end(const std::string& caller, bool is_large) {
  const MutexLock lock(mutex_);
  const auto line = std::ranges::find(lines_, caller, &Line::caller);
  --line->running;
  line->large_running -= is_large ? 1 : 0;
  large_running_ -= is_large ? 1 : 0;
  if (line->running == 0 && line->waiting.empty()) lines_.erase(line);
  // This thread runs what may run now.
  if (ending_) changed_.notify_all();
}

void CallPool::wake_if_waiting() {
  const auto may_go_on = [this](const Line& line) {
    return !line.waiting.empty() && line.running < most_.threads_per_caller;
  };
  if (waiting_ > 0 && std::ranges::any_of(lines_, may_go_on)) changed_.notify_one();
}

void CallPool::serve() {
  for (;;) {
    std::optional<Task> task;
    {
      MutexLock lock(mutex_);
      const auto has_work = [&]() CELLCRUSH_REQUIRES(mutex_) {
        task = next();
        return task || (ending_ && lines_.empty());
      };
      // A cancelled call wakes nobody.
      while (!changed_.wait_for(lock, kBetweenLooks, has_work)) continue;
      if (!task) return;
    }
    const std::string caller = task->caller;
    const bool is_large = task->is_large;
    run_here(*std::exchange(task, std::nullopt));
    end(caller, is_large);
  }
}

}  // namespace cellcrush::rpc
