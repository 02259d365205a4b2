#include "jobs/scheduler.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <system_error>

#include "error.h"
#include "jobs/deletion.h"
#include "jobs/job_state.h"
#include "jobs/outcome.h"
#include "jobs/resource_name.h"

namespace cellcrush::jobs {
namespace {

// The job was cancelled, and perhaps deleted, while a worker was started for it.
struct Withdrawn {};

}  // namespace

void Scheduler::start(int slots) {
  finish_deletions(parts_.reader, parts_.journal, parts_.folder);
  fail_lost_jobs();
  for (const auto& job : parts_.reader.queued_jobs(v1::PENDING)) waiting_.add(job);
  free_cores_ = slots;
  for (int i = 0; i < slots; ++i) slots_.emplace_back([this](const std::stop_token& stop) { run_slot(stop); });
}

void Scheduler::fail_lost_jobs() {
  for (const std::int64_t job : parts_.reader.jobs_in(v1::CANCELLING))
    parts_.journal.change_state(job, cancelled_without_result());
  for (const std::int64_t job : parts_.reader.jobs_in(v1::RUNNING)) {
    spdlog::warn("{} was left running by an earlier daemon: failed, worker lost", name_of(job));
    parts_.journal.change_state(job, worker_lost());
  }
}

void Scheduler::enqueue(const std::vector<store::QueuedJob>& jobs) {
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& job : jobs) waiting_.add(job);
    tell_metrics();
  }
  changed_.notify_all();
}

void Scheduler::cancel(std::int64_t job) {
  // Between reading a state and changing it the job may move on; it does so only a few times.
  while (true) {
    const auto stored = parts_.reader.find_job(job);
    if (!stored) throw ServiceError(ServiceError::Kind::not_found, "There is no " + name_of(job) + ".");
    const v1::JobState state = stored->job.state();
    if (state == v1::CANCELLED || state == v1::CANCELLING) return;
    if (is_terminal(state)) {
      throw ServiceError(
          ServiceError::Kind::failed_precondition,
          name_of(job) + " has ended already: it is " + v1::JobState_Name(state) + " and cannot be cancelled.");
    }
    store::StateChange change;
    change.state = state == v1::RUNNING ? v1::CANCELLING : v1::CANCELLED;
    change.worker_pid = stored->job.worker_pid();
    try {
      parts_.journal.change_state(job, change);
    } catch (const ServiceError& error) {
      if (error.kind() == ServiceError::Kind::failed_precondition) continue;
      throw;
    }
    std::stop_source worker(std::nostopstate);
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = running_.find(job); found != running_.end()) worker = found->second;
    }
    worker.request_stop();
    return;
  }
}

void Scheduler::cancel_all(const std::vector<std::int64_t>& jobs) {
  // First those that wait, so that no slot goes on to the next of them.
  parts_.journal.cancel_waiting(jobs);
  for (const std::int64_t job : jobs) {
    const auto stored = parts_.reader.find_job(job);
    if (!stored || is_terminal(stored->job.state())) continue;
    try {
      cancel(job);
    } catch (const ServiceError& error) {
      // It has ended, or was deleted, in the meantime.
      const bool gone = error.kind() == ServiceError::Kind::not_found;
      if (!gone && error.kind() != ServiceError::Kind::failed_precondition) throw;
    }
  }
}

void Scheduler::stop() {
  for (auto& slot : slots_) slot.request_stop();
  slots_.clear();
}

void Scheduler::run_slot(const std::stop_token& stop) {
  while (true) {
    std::optional<store::QueuedJob> taken;
    int cores = 1;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [this, &taken] { return free_cores_ > 0 && (taken = waiting_.take()).has_value(); });
      if (!taken || stop.stop_requested()) return;
      --free_cores_;
    }
    try {
      run_job(taken->job, cores, stop);
    } catch (const Withdrawn&) {
      spdlog::info("{} was cancelled before it ran", name_of(taken->job));
    } catch (const std::exception& error) {
      finish(taken->job, outcome_of(error), stop);
    }
    {
      const std::scoped_lock lock(mutex_);
      running_.erase(taken->job);
      waiting_.give_back(*taken);
      free_cores_ += cores;
      tell_metrics();
    }
    changed_.notify_all();
  }
}

void Scheduler::run_job(std::int64_t job, int& cores, const std::stop_token& stop) {
  const auto stored = parts_.reader.find_job(job);
  if (!stored || stored->job.state() != v1::PENDING) return;
  std::stop_token cancel;
  {
    const std::scoped_lock lock(mutex_);
    cancel = running_[job].get_token();
    tell_metrics();
  }
  cores += take_cores(stored->job.case_().numerics().threads() - 1);
  const auto exit = run_worker(*stored, cores, {stop, cancel});
  // What a worker that was ended had begun.
  std::error_code ignored;
  std::filesystem::remove(parts_.folder.partial_result(job), ignored);
  finish(job, outcome_of(exit), stop);
}

int Scheduler::take_cores(int asked) {
  const std::scoped_lock lock(mutex_);
  const int taken = std::clamp(free_cores_ - static_cast<int>(waiting_.count()), 0, std::max(asked, 0));
  free_cores_ -= taken;
  return taken;
}

WorkerExit Scheduler::run_worker(const store::StoredJob& stored, int threads, const Interruptions& interruptions) {
  const std::int64_t job = stored.number;
  const auto channel = parts_.hub.open(job);
  parts_.folder.prepare_job_folder(job);
  worker::Order order;
  order.set_job(name_of(job));
  *order.mutable_case_() = stored.job.case_();
  order.set_result_path(parts_.folder.result(job).string());
  order.set_threads(threads);

  WorkerEvents events;
  events.started = [this, job](int pid) {
    store::StateChange running;
    running.state = v1::RUNNING;
    running.worker_pid = pid;
    try {
      parts_.journal.change_state(job, running);
    } catch (const ServiceError& error) {
      const bool gone = error.kind() == ServiceError::Kind::not_found;
      if (gone || error.kind() == ServiceError::Kind::failed_precondition) throw Withdrawn();
      throw;
    }
    spdlog::info("{} runs in process {}", name_of(job), pid);
  };
  events.reported = [this, job, &channel](const worker::Report& report) { pass_on(job, *channel, report); };
  return parts_.executor.run(order, events, interruptions);
}

void Scheduler::pass_on(std::int64_t job, watch::Channel& channel, const worker::Report& report) {
  switch (report.report_case()) {
    case worker::Report::kMesh: parts_.journal.set_mesh(job, report.mesh()); break;
    case worker::Report::kSample: parts_.journal.append_sample(job, report.sample()); break;
    case worker::Report::kFrame: channel.publish(report.frame()); break;
    case worker::Report::kProgress: channel.publish(report.progress()); break;
    case worker::Report::kFinal:
    case worker::Report::kStopping:
    case worker::Report::REPORT_NOT_SET: break;
  }
}

void Scheduler::finish(std::int64_t job, const store::StateChange& outcome, const std::stop_token& stop) {
  while (true) {
    try {
      parts_.journal.change_state(job, outcome);
      parts_.metrics.count_ended(outcome.state, outcome.summary ? &*outcome.summary : nullptr);
      spdlog::info("{} {}{}{}", name_of(job), v1::JobState_Name(outcome.state), outcome.message.empty() ? "" : ": ",
                   outcome.message);
      return;
    } catch (const ServiceError& error) {
      spdlog::error("The end of {} cannot be made durable: {}", name_of(job), error.what());
      const bool gone = error.kind() == ServiceError::Kind::not_found;
      if (gone || error.kind() == ServiceError::Kind::failed_precondition) return;
    }
    // A full disk may get room again. At the daemon's end the job stays RUNNING, and the next daemon marks it as lost.
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; }) || stop.stop_requested()) return;
  }
}

}  // namespace cellcrush::jobs
