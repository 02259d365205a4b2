#include "slurm/executor_run.h"

namespace cellcrush::testing {

worker::Order order_of(const v1::Case& submitted) {
  worker::Order out;
  out.set_job("jobs/1");
  *out.mutable_case_() = submitted;
  out.set_threads(1);
  out.set_checkpoint_interval_s(0.5);
  return out;
}

ExecutorRun::ExecutorRun(jobs::Executor& executor, const store::JobFolder& folder, const worker::Order& order) {
  const auto change = [this](const auto& what) {
    {
      const std::lock_guard lock(mutex_);
      what();
    }
    changed_.notify_all();
  };
  thread_ = std::thread([this, &executor, folder, order, change] {
    jobs::WorkerEvents events;
    events.started = [&](int process) { change([&] { started_ = process; }); };
    events.watched = [] { return true; };
    events.placed = [&](const std::string& place) { change([&] { place_ = place; }); };
    events.reported = [&](const worker::Report& report) {
      change([&] {
        if (report.has_sample()) samples_.push_back(report.sample().SerializeAsString());
        if (report.has_begun()) begun_steps_.push_back(report.begun().step());
      });
    };
    jobs::WorkerExit exit;
    std::exception_ptr error;
    try {
      exit = executor.run(folder, order, events, {stop_.get_token(), suspend_.get_token(), cancel_.get_token()});
    } catch (...) {
      error = std::current_exception();
    }
    change([&] {
      exit_ = exit;
      error_ = error;
      ended_ = true;
    });
  });
}

ExecutorRun::~ExecutorRun() {
  leave();
  thread_.join();
}

int ExecutorRun::wait_for_start(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, limit, [this] { return started_ != 0 || ended_; });
  return started_;
}

bool ExecutorRun::wait_for_samples(std::size_t count, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, limit, [&] { return samples_.size() >= count || ended_; }) && samples_.size() >= count;
}

std::string ExecutorRun::wait_for_place(const std::string& text, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, limit, [&] { return place_.find(text) != std::string::npos || ended_; });
  return place_;
}

jobs::WorkerExit ExecutorRun::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ended_; });
  if (error_) std::rethrow_exception(error_);
  return exit_;
}

bool ExecutorRun::has_ended() {
  const std::lock_guard lock(mutex_);
  return ended_;
}

std::vector<std::string> ExecutorRun::samples() {
  const std::lock_guard lock(mutex_);
  return samples_;
}

std::vector<std::int64_t> ExecutorRun::begun_steps() {
  const std::lock_guard lock(mutex_);
  return begun_steps_;
}

}  // namespace cellcrush::testing
