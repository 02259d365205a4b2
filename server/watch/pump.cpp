#include "watch/pump.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace cellcrush::watch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kTick{1};
constexpr std::chrono::milliseconds kBeatOfATask{1};
constexpr std::chrono::milliseconds kLongestBeat{200};

struct Work final : Pump::Task {
  explicit Work(std::function<void()> given) : Task("the daemon"), work(std::move(given)) {}
  void run() override { work(); }
  std::function<void()> work;
};

}  // namespace

Pump::Pump(int threads) : most_of_caller_(std::max(1, threads / 2)) {
  threads_.emplace_back([this](const std::stop_token& stop) { tick(stop); });
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

void Pump::stop() {
  for (auto& thread : threads_) thread.request_stop();
  threads_.clear();
  // Outside the lock: destroying a task may schedule others.
  Lines dropped;
  std::vector<std::shared_ptr<Task>> waiting;
  const MutexLock lock(mutex_);
  turns_.clear();
  dropped.swap(lines_);
  waiting.swap(waiting_);
}

void Pump::add(const std::shared_ptr<Task>& task) {
  const MutexLock lock(mutex_);
  tasks_.push_back(task);
  push(task);
}

void Pump::schedule(const std::shared_ptr<Task>& task) {
  const MutexLock lock(mutex_);
  push(task);
}

void Pump::wake(const std::shared_ptr<Task>& task) {
  const MutexLock lock(mutex_);
  if (task->queued_ || task->waits_) return;
  const auto now = Clock::now();
  if (now - task->woken_ >= beat()) {
    task->woken_ = now;
    return push(task);
  }
  task->waits_ = true;
  waiting_.push_back(task);
  if (waiting_.size() == 1) beaten_.notify_one();
}

Clock::duration Pump::beat() const {
  return std::min<Clock::duration>(kLongestBeat, kBeatOfATask * tasks_.size());
}

void Pump::post(std::function<void()> work) { schedule(std::make_shared<Work>(std::move(work))); }

void Pump::drain() {
  {
    const MutexLock lock(mutex_);
    draining_ = true;
  }
  schedule_all();
}

bool Pump::draining() const {
  const MutexLock lock(mutex_);
  return draining_;
}

void Pump::push(const std::shared_ptr<Task>& task) {
  if (task->queued_) return;
  task->queued_ = true;
  const auto line = lines_.try_emplace(task->caller_).first;
  line->second.tasks.push_back(task);
  line_up(line);
}

void Pump::line_up(Lines::iterator line) {
  auto& [tasks, running, has_turn] = line->second;
  if (has_turn || tasks.empty() || running >= most_of_caller_) return;
  has_turn = true;
  turns_.push_back(line);
  changed_.notify_one();
}

void Pump::end(Lines::iterator line) {
  const MutexLock lock(mutex_);
  --line->second.running;
  line_up(line);
  if (line->second.running == 0 && line->second.tasks.empty()) lines_.erase(line);
}

void Pump::work(const std::stop_token& stop) {
  while (true) {
    std::shared_ptr<Task> task;
    Lines::iterator line;
    {
      MutexLock lock(mutex_);
      if (!changed_.wait(lock, stop, [this]() CELLCRUSH_REQUIRES(mutex_) { return !turns_.empty(); })) return;
      line = turns_.front();
      turns_.pop_front();
      auto& [tasks, running, has_turn] = line->second;
      task = std::move(tasks.front());
      tasks.pop_front();
      task->queued_ = false;
      has_turn = false;
      ++running;
      line_up(line);
    }
    try {
      task->run();
    } catch (const std::exception& error) {
      spdlog::error("A watch could not be advanced and will be retried: {}", error.what());
    }
    task.reset();
    end(line);
  }
}

void Pump::tick(const std::stop_token& stop) {
  auto next_tick = Clock::now() + kTick;
  auto next_beat = Clock::now();
  while (!stop.stop_requested()) {
    {
      MutexLock lock(mutex_);
      const auto has_waiting = [this]() CELLCRUSH_REQUIRES(mutex_) { return !waiting_.empty(); };
      if (beaten_.wait_until(lock, stop, next_tick, has_waiting)) {
        beaten_.wait_until(lock, stop, next_beat, [] { return false; });
        const auto now = Clock::now();
        for (const auto& task : std::exchange(waiting_, {})) {
          task->waits_ = false;
          task->woken_ = now;
          push(task);
        }
        next_beat = now + beat();
      }
    }
    if (stop.stop_requested() || Clock::now() < next_tick) continue;
    schedule_all();
    next_tick = Clock::now() + kTick;
  }
}

void Pump::schedule_all() {
  // Released after the lock: destroying a task may schedule others.
  std::vector<std::shared_ptr<Task>> alive;
  const MutexLock lock(mutex_);
  std::erase_if(tasks_, [&alive](const std::weak_ptr<Task>& task) {
    alive.push_back(task.lock());
    return alive.back() == nullptr;
  });
  for (const auto& task : alive) {
    if (task) push(task);
  }
}

}  // namespace cellcrush::watch
