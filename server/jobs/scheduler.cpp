#include "jobs/scheduler.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "error.h"
#include "jobs/queue_forecast.h"
#include "store/job_state.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {

void Scheduler::start(int slots) {
  const auto adopted = reconcile();
  const auto waiting = parts_.reader.queued_jobs(v1::Job::PENDING, parts_.executor_name);
  // No job runs before all are queued: a job that returned to the queue would be queued twice.
  const MutexLock lock(mutex_);
  free_cores_ += slots;
  for (const auto& job : waiting) {
    if (!running_.contains(job.job)) waiting_.add(job);
  }
  for (const auto& job : adopted) spawn([this, job] { run(job); });
  spawn([this] { run_next(); });
}

void Scheduler::spawn(std::function<void()> work) {
  ended_.clear();
  std::jthread thread([this, work = std::move(work)] {
    work();
    const MutexLock lock(mutex_);
    const auto own = threads_.find(std::this_thread::get_id());
    if (own == threads_.end()) return;
    ended_.push_back(std::move(own->second));
    threads_.erase(own);
  });
  threads_.emplace(thread.get_id(), std::move(thread));
}

std::vector<store::QueuedJob> Scheduler::reconcile() {
  std::vector<store::QueuedJob> adopted;
  for (const v1::Job::State state : {v1::Job::RUNNING, v1::Job::CANCELLING}) {
    for (const auto& job : parts_.reader.queued_jobs(state, parts_.executor_name)) {
      if (parts_.runner.reconcile(job.job) != JobRunner::Left::is_to_run) continue;
      adopt(job, adopted);
      if (state == v1::Job::CANCELLING) cancel_run(job.job);
    }
  }
  // A worker of this machine makes its job RUNNING at once.
  if (shares_cores()) return adopted;
  for (const auto& job : parts_.reader.queued_jobs(v1::Job::PENDING, parts_.executor_name)) {
    if (is_placed(job.job)) adopt(job, adopted);
  }
  return adopted;
}

bool Scheduler::is_placed(std::int64_t job) {
  try {
    return parts_.executor.has_worker(parts_.folder.job_folder(job));
  } catch (const std::exception& error) {
    // It waits for a slot, and the executor adopts it then.
    spdlog::warn("Cannot tell whether {} has {}: {}", parts_.executor_name, store::name_of(job), error.what());
    return false;
  }
}

void Scheduler::adopt(const store::QueuedJob& job, std::vector<store::QueuedJob>& adopted) {
  spdlog::info("{} is adopted from an earlier daemon", store::name_of(job.job));
  const MutexLock lock(mutex_);
  --free_cores_;
  waiting_.count_running(job);
  begin(job.job);
  adopted.push_back(job);
}

void Scheduler::enqueue(const std::vector<store::QueuedJob>& jobs) {
  {
    const MutexLock lock(mutex_);
    for (const auto& job : jobs) waiting_.add(job);
    tell_metrics();
    if (free_cores_ <= 0) return;  // the next run that ends looks
  }
  wake();
}

void Scheduler::cancel(std::int64_t job) {
  // The job may change between reading its state and changing it, but only a few times.
  while (true) {
    const auto stored = find(job);
    const v1::Job::State state = stored.job.state();
    if (state == v1::Job::CANCELLED || state == v1::Job::CANCELLING) return;
    if (store::is_terminal(state)) {
      throw ServiceError(ServiceError::Kind::failed_precondition, store::name_of(job) + " has already ended: it is " +
                                                                      v1::Job::State_Name(state) +
                                                                      " and cannot be cancelled.");
    }
    store::StateChange change;
    change.state = state == v1::Job::RUNNING ? v1::Job::CANCELLING : v1::Job::CANCELLED;
    change.worker_pid = stored.job.worker_pid();
    if (state == v1::Job::SUSPENDED)
      change.message = "The job was cancelled while suspended and has no result. The history is kept.";
    if (!try_change(parts_.journal, job, change)) continue;
    {
      const MutexLock lock(mutex_);
      // A CANCELLING job may have returned to the queue meanwhile, to be given up.
      if (change.state == v1::Job::CANCELLED) waiting_.remove(job);
    }
    cancel_run(job);
    if (change.state == v1::Job::CANCELLED) end_unfollowed(job);
    return;
  }
}

void Scheduler::cancel_run(std::int64_t job) {
  std::stop_source cancel(std::nostopstate);
  {
    const MutexLock lock(mutex_);
    if (const auto found = running_.find(job); found != running_.end()) cancel = found->second.cancel;
  }
  cancel.request_stop();
}

void Scheduler::end_unfollowed(std::int64_t job) {
  if (!parts_.executor.keeps_workers()) return;
  {
    const MutexLock lock(mutex_);
    if (running_.contains(job)) return;
  }
  try {
    parts_.runner.end_leftover(job);
  } catch (const std::exception& error) {
    spdlog::warn("What {} computes of {} could not be ended: {}", parts_.executor_name, store::name_of(job),
                 error.what());
  }
}

void Scheduler::suspend(std::int64_t job, const std::function<bool()>& given_up) {
  while (true) {
    const v1::Job::State state = find(job).job.state();
    if (state == v1::Job::SUSPENDED) return wait_for_end(job);
    if (state != v1::Job::PENDING && state != v1::Job::RUNNING) {
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         store::name_of(job) + " is " + v1::Job::State_Name(state) + " and cannot be suspended.");
    }
    if (given_up())
      throw ServiceError(ServiceError::Kind::cancelled,
                         store::name_of(job) + " was not yet suspended when the call ended.");
    MutexLock lock(mutex_);
    const auto found = running_.find(job);
    if (found != running_.end()) {
      found->second.suspend.request_stop();
      changed_.wait_for(lock, std::chrono::milliseconds(100),
                        [this, job]() CELLCRUSH_REQUIRES(mutex_) { return !running_.contains(job); });
      continue;
    }
    if (state != v1::Job::PENDING) {
      // Its outcome is about to be written.
      changed_.wait_for(lock, std::chrono::milliseconds(20));
      continue;
    }
    lock.unlock();
    const auto queued = parts_.reader.queued_job(job, v1::Job::PENDING);
    lock.lock();
    if (!queued || running_.contains(job)) continue;
    waiting_.remove(job);
    lock.unlock();
    store::StateChange change;
    change.state = v1::Job::SUSPENDED;
    try {
      try_change(parts_.journal, job, change);
    } catch (const ServiceError&) {
      // If that cannot be written, it waits as before.
      enqueue({*queued});
      throw;
    }
  }
}

// A job that is resumed while its last run still holds the request to suspend it would be suspended again.
void Scheduler::wait_for_end(std::int64_t job) {
  constexpr std::chrono::seconds kLongest{1};
  MutexLock lock(mutex_);
  changed_.wait_for(lock, kLongest, [this, job]() CELLCRUSH_REQUIRES(mutex_) { return !running_.contains(job); });
}

void Scheduler::resume(std::int64_t job) {
  const v1::Job::State state = find(job).job.state();
  if (state == v1::Job::PENDING || state == v1::Job::RUNNING) return;
  if (state != v1::Job::SUSPENDED) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       store::name_of(job) + " is " + v1::Job::State_Name(state) + " and cannot be resumed.");
  }
  // Read before the change: a PENDING job is in the queue.
  const auto queued = parts_.reader.queued_job(job, v1::Job::SUSPENDED);
  store::StateChange change;
  change.state = v1::Job::PENDING;
  parts_.journal.change_state(job, change);
  if (queued) enqueue({*queued});
}

void Scheduler::requeue(const std::vector<store::QueuedJob>& jobs) {
  {
    const MutexLock lock(mutex_);
    for (const auto& job : jobs) {
      if (!running_.contains(job.job)) waiting_.add(job);
    }
    tell_metrics();
  }
  wake();
}

void Scheduler::dequeue(const std::vector<std::int64_t>& jobs) {
  const MutexLock lock(mutex_);
  for (const std::int64_t job : jobs) waiting_.remove(job);
  tell_metrics();
}

void Scheduler::forget(const std::vector<std::int64_t>& jobs) {
  for (const std::int64_t job : jobs) {
    {
      const MutexLock lock(mutex_);
      waiting_.remove(job);
    }
    cancel_run(job);
  }
  const MutexLock lock(mutex_);
  tell_metrics();
}

void Scheduler::hold_for_low_disk(const std::optional<std::string>& reason) {
  parts_.hold.set_low_disk(reason);
  std::vector<std::stop_source> leave;
  {
    const MutexLock lock(mutex_);
    if (std::exchange(low_disk_, reason.has_value()) == reason.has_value() || !reason) return;
    // What a cluster computes needs no room here until it has ended.
    if (!shares_cores()) return;
    for (auto& [job, running] : running_) leave.push_back(running.leave);
  }
  for (auto& source : leave) source.request_stop();
}

std::size_t Scheduler::waiting_count() {
  const MutexLock lock(mutex_);
  return waiting_.count();
}

std::size_t Scheduler::waiting_count(const std::string& owner) {
  const MutexLock lock(mutex_);
  return waiting_.count_of(owner);
}

void Scheduler::add_load(Load& to) {
  const MutexLock lock(mutex_);
  waiting_.add_load(to);
}

void Scheduler::begin_stop() { end_.request_stop(); }

void Scheduler::stop() {
  begin_stop();
  while (true) {
    std::map<std::thread::id, std::jthread> running;
    std::vector<std::jthread> ended;
    {
      const MutexLock lock(mutex_);
      running.swap(threads_);
      ended.swap(ended_);
    }
    // They may spawn others until they have seen the request.
    if (running.empty() && ended.empty()) return;
  }
}

bool Scheduler::spawn_next() {
  try {
    spawn([this] { run_next(); });
    return true;
  } catch (const std::system_error& error) {
    spdlog::warn("{} has no thread for a further job, which waits: {}", parts_.executor_name, error.what());
    return false;
  }
}

void Scheduler::run_next() {
  bool is_relieved = false;
  while (!is_relieved && !end_.stop_requested()) {
    std::optional<store::QueuedJob> taken;
    bool is_trial = false;
    {
      MutexLock lock(mutex_);
      const bool is_open = parts_.hold.is_open();
      if (is_open && free_cores_ > 0) taken = waiting_.take();
      if (!taken) {
        wait_for_change(lock, is_open ? std::nullopt : parts_.hold.next_try());
        continue;
      }
      is_trial = parts_.hold.begin_start();
      --free_cores_;
      begin(taken->job);
      is_relieved = spawn_next();
    }
    run(*taken);
    if (is_trial) parts_.hold.end_trial();
  }
}

void Scheduler::wait_for_change(MutexLock& lock, const std::optional<Hold::Clock::time_point>& limit) {
  const auto stop = end_.get_token();
  const auto has_changed = [this, seen = changes_]() CELLCRUSH_REQUIRES(mutex_) { return changes_ != seen; };
  limit ? changed_.wait_until(lock, stop, *limit, has_changed) : changed_.wait(lock, stop, has_changed);
}

void Scheduler::wake() {
  {
    const MutexLock lock(mutex_);
    ++changes_;
  }
  changed_.notify_all();
}

void Scheduler::begin(std::int64_t job) {
  Running& running = running_[job];
  if (low_disk_ && shares_cores()) running.leave.request_stop();
  tell_metrics();
}

void Scheduler::run(const store::QueuedJob& taken) {
  Running running;
  {
    const MutexLock lock(mutex_);
    running = running_[taken.job];
  }
  const auto stop = end_.get_token();
  const int extra = take_cores(taken);
  const std::stop_callback leave_at_the_end(stop, [&running] { running.leave.request_stop(); });
  const bool again = parts_.runner.run(
      taken.job, 1 + extra, {running.leave.get_token(), running.suspend.get_token(), running.cancel.get_token()}, stop);
  {
    const MutexLock lock(mutex_);
    running_.erase(taken.job);
    waiting_.give_back(taken, 1 + extra);
    if (again) waiting_.add(taken);
    free_cores_ += held_by(1 + extra);
    tell_metrics();
  }
  wake();
}

// A job whose threads cannot be read runs on one core, if it runs.
int Scheduler::take_cores(const store::QueuedJob& job) {
  int threads = 1;
  try {
    if (const auto stored = parts_.reader.find_job(job.job)) threads = stored->job.case_().numerics().threads();
  } catch (const std::exception& error) {
    spdlog::warn("Cannot read the number of threads of {}: {}", store::name_of(job.job), error.what());
  }
  const MutexLock lock(mutex_);
  const int taken = shares_cores() ? extra_cores(threads, free_cores_, waiting_.count()) : std::max(threads - 1, 0);
  if (shares_cores()) free_cores_ -= taken;
  running_[job.job].cores += taken;
  waiting_.add_cores(job, taken);
  return taken;
}

int Scheduler::cores_of(std::int64_t job) {
  const MutexLock lock(mutex_);
  const auto found = running_.find(job);
  return found == running_.end() ? 1 : found->second.cores;
}

store::StoredJob Scheduler::find(std::int64_t job) {
  auto stored = parts_.reader.find_job(job);
  if (!stored) throw ServiceError(ServiceError::Kind::not_found, "There is no " + store::name_of(job) + ".");
  return *std::move(stored);
}

}  // namespace cellcrush::jobs
