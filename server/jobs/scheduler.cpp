#include "jobs/scheduler.h"

#include <spdlog/spdlog.h>

#include <chrono>

#include "error.h"
#include "jobs/job_state.h"
#include "jobs/outcome.h"

namespace cellcrush::jobs {

void Scheduler::start(int slots) {
  fail_lost_jobs();
  for (const std::int64_t job : parts_.reader.jobs_in(v1::PENDING)) enqueue(job);
  for (int i = 0; i < slots; ++i) slots_.emplace_back([this](const std::stop_token& stop) { run_slot(stop); });
}

void Scheduler::fail_lost_jobs() {
  for (const v1::JobState state : {v1::RUNNING, v1::CANCELLING}) {
    for (const std::int64_t job : parts_.reader.jobs_in(state)) {
      spdlog::warn("{} was left running by an earlier daemon: failed, worker lost", name_of(job));
      parts_.journal.change_state(job, worker_lost());
    }
  }
}

void Scheduler::enqueue(std::int64_t job) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back(job);
  }
  changed_.notify_one();
}

void Scheduler::stop() {
  for (auto& slot : slots_) slot.request_stop();
  slots_.clear();
}

void Scheduler::run_slot(const std::stop_token& stop) {
  while (true) {
    std::int64_t job = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [this] { return !waiting_.empty(); });
      if (stop.stop_requested()) return;
      job = waiting_.front();
      waiting_.pop_front();
    }
    try {
      run_job(job, stop);
    } catch (const std::exception& error) {
      finish(job, outcome_of(error), stop);
    }
  }
}

void Scheduler::run_job(std::int64_t job, const std::stop_token& stop) {
  const auto stored = parts_.reader.find_job(job);
  if (!stored || stored->job.state() != v1::PENDING) return;
  const auto channel = parts_.hub.open(job);
  parts_.folder.prepare_job_folder(job);
  worker::Order order;
  order.set_job(name_of(job));
  *order.mutable_case_() = stored->job.case_();
  order.set_result_path(parts_.folder.result(job).string());

  WorkerEvents events;
  events.started = [this, job](int pid) {
    spdlog::info("{} runs in process {}", name_of(job), pid);
    store::StateChange running;
    running.state = v1::RUNNING;
    running.worker_pid = pid;
    parts_.journal.change_state(job, running);
  };
  events.reported = [this, job, &channel](const worker::Report& report) { pass_on(job, *channel, report); };
  finish(job, outcome_of(parts_.executor.run(order, events, stop)), stop);
}

void Scheduler::pass_on(std::int64_t job, watch::Channel& channel, const worker::Report& report) {
  switch (report.report_case()) {
    case worker::Report::kMesh: parts_.journal.set_mesh(job, report.mesh()); break;
    case worker::Report::kSample: parts_.journal.append_sample(job, report.sample()); break;
    case worker::Report::kFrame: channel.publish(report.frame()); break;
    case worker::Report::kProgress: channel.publish(report.progress()); break;
    case worker::Report::kFinal:
    case worker::Report::REPORT_NOT_SET: break;
  }
}

void Scheduler::finish(std::int64_t job, const store::StateChange& outcome, const std::stop_token& stop) {
  while (true) {
    try {
      parts_.journal.change_state(job, outcome);
      spdlog::info("{} {}{}{}", name_of(job), v1::JobState_Name(outcome.state), outcome.message.empty() ? "" : ": ",
                   outcome.message);
      return;
    } catch (const ServiceError& error) {
      spdlog::error("The end of {} cannot be made durable: {}", name_of(job), error.what());
      if (error.kind() == ServiceError::Kind::failed_precondition) return;
    }
    // A full disk may get room again. At the daemon's end the job stays RUNNING, and the next daemon marks it as lost.
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; }) || stop.stop_requested()) return;
  }
}

}  // namespace cellcrush::jobs
