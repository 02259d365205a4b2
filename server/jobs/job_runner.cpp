#include "jobs/job_runner.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <memory>
#include <utility>

#include "error.h"
#include "jobs/outcome.h"
#include "jobs/queue_forecast.h"
#include "pause.h"
#include "store/job_state.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::jobs {
namespace {

// The job was cancelled, suspended or deleted while its worker was starting.
struct Withdrawn {};

// The workers' files are invalid, and the job must restart from step 0; holds the reason.
struct BeginAgain {
  std::string why;
};

constexpr const char* kReportsAreGone =
    "Restarted from step 0: the reports of its earlier workers are missing from its folder.";

void log_begin(const std::string& job, const worker::Begun& begun) {
  for (const auto& refused : begun.refused_checkpoints()) spdlog::warn("{}: {}", job, refused);
  if (begun.step() > 0) spdlog::info("{} resumes at step {}", job, begun.step());
}

}  // namespace

bool try_change(store::Journal& journal, std::int64_t job, const store::StateChange& change) {
  try {
    journal.change_state(job, change);
    return true;
  } catch (const ServiceError& error) {
    if (error.kind() != ServiceError::Kind::failed_precondition) throw;
    return false;
  }
}

JobRunner::JobRunner(const Parts& parts)
    : parts_(parts),
      states_({parts.folder, parts.journal, parts.reader, parts.metrics, parts.hold, parts.stopped,
               [this](std::int64_t job) { losses_.forget(job); }}) {}

bool JobRunner::run(std::int64_t job, int threads, const Interruptions& interruptions,
                    const std::stop_token& daemons_end) {
  while (true) {
    Run run{threads, interruptions, daemons_end, {}, 0.0, 0.0};
    v1::Job::State state = run_once(job, run);
    if (const auto channel = parts_.hub.find(job)) channel->set_place("");
    if (run.trouble) {
      parts_.hold.failed(run.trouble);
      state = states_.put_back(job, run.trouble, daemons_end);
      // It was cancelled meanwhile, by a call that left its worker to this run.
      if (store::is_terminal(state) && parts_.executor.keeps_workers()) end_leftover_if_possible(job);
    }
    // It is CANCELLING if it was cancelled just after its worker had left it: it then ends with the samples so far.
    if (state != v1::Job::CANCELLING) return state == v1::Job::PENDING;
    if (run.trouble && !pause_unless_stopped(daemons_end, StateWriter::kBetweenTries)) return false;
  }
}

v1::Job::State JobRunner::run_once(std::int64_t job, Run& run) {
  store::StateChange next;
  try {
    const auto stored = parts_.reader.find_job(job);
    if (stored && store::is_terminal(stored->job.state()) && parts_.executor.keeps_workers())
      end_leftover_if_possible(job);
    if (!stored || stored->job.state() == v1::Job::SUSPENDED || store::is_terminal(stored->job.state()))
      return v1::Job::JOB_STATE_UNSPECIFIED;
    try {
      next = next_of(*stored, run);
    } catch (const BeginAgain& reason) {
      return begin_again(job, reason.why);
    }
  } catch (const Withdrawn&) {
    spdlog::info("{} was cancelled before it started", store::name_of(job));
    return v1::Job::JOB_STATE_UNSPECIFIED;
  } catch (const std::exception& error) {
    run.trouble = trouble_of(error);
    if (!run.trouble || !parts_.executor.keeps_workers()) end_leftover_if_possible(job);
    next = outcome_of(error);
  }
  parts_.metrics.set_speed(job, 0.0);
  if (run.trouble) return v1::Job::JOB_STATE_UNSPECIFIED;
  // Its state is unchanged, and it is to be rerun.
  if (next.state == v1::Job::JOB_STATE_UNSPECIFIED) return v1::Job::PENDING;
  const auto written = states_.write(job, next, run.daemons_end);
  if (written == v1::Job::SUCCEEDED && run.predicted_seconds > 0.0 && run.seconds > 0.0)
    parts_.metrics.observe_run(run.seconds, run.predicted_seconds);
  return written;
}

store::StateChange JobRunner::next_of(const store::StoredJob& stored, Run& run) {
  const bool has_begun = stored.job.state() == v1::Job::RUNNING || stored.job.state() == v1::Job::CANCELLING;
  if (!has_begun && !parts_.folder.keep_ballast())
    throw ServiceError(Shortage::full_disk, "The data folder's disk is full.");
  if (!has_begun || parts_.executor.has_worker(parts_.folder.job_folder(stored.number)))
    return after(stored, run_worker(stored, run), run);
  if (auto next = left_behind(stored)) return *std::move(next);
  return given_up(stored, cancelled_without_result(), run);
}

std::optional<store::StateChange> JobRunner::left_behind(const store::StoredJob& stored) {
  parts_.folder.make_job_folder(stored.number);
  const auto last_word = parts_.executor.read_final_report(parts_.folder.job_folder(stored.number), events_of(stored));
  if (last_word && last_word->final && last_word->final->has_begin_again())
    throw BeginAgain{last_word->final->begin_again()};
  if (last_word) return outcome_of(*last_word);
  if (stored.job.state() == v1::Job::CANCELLING) return std::nullopt;
  return tried_again(worker_missing());
}

JobRunner::Left JobRunner::reconcile(std::int64_t job) {
  try {
    if (parts_.executor.has_worker(parts_.folder.job_folder(job))) return Left::is_to_run;
    const auto stored = parts_.reader.find_job(job);
    if (!stored) return Left::ended;
    std::optional<store::StateChange> next;
    try {
      next = left_behind(*stored);
    } catch (const BeginAgain& reason) {
      return begin_again(job, reason.why) == v1::Job::CANCELLING ? Left::is_to_run : Left::waits;
    } catch (const ServiceError& error) {
      if (error.kind() != ServiceError::Kind::data_loss) throw;
      next = outcome_of(error);
    }
    std::string logged;
    const auto written = next ? states_.try_write(job, *next, logged) : std::nullopt;
    if (!written || *written == v1::Job::CANCELLING) return Left::is_to_run;
    return next->state == v1::Job::PENDING ? Left::waits : Left::ended;
  } catch (const std::exception& error) {
    spdlog::warn("Could not take over {} from an earlier daemon; trying again: {}", store::name_of(job), error.what());
    return Left::is_to_run;
  }
}

void JobRunner::end_leftover(std::int64_t job) { parts_.executor.end_worker(parts_.folder.job_folder(job)); }

void JobRunner::end_leftover_if_possible(std::int64_t job) {
  try {
    end_leftover(job);
  } catch (const std::exception& error) {
    // The folder's lock refuses the job's next worker, which then adopts this one.
    spdlog::warn("A worker of {} may still run: {}", store::name_of(job), error.what());
  }
}

worker::Order JobRunner::order_of(const store::StoredJob& stored) const {
  if (!stored.has_case) throw store::unreadable_case(stored.number);
  worker::Order order;
  order.set_job(store::name_of(stored.number));
  *order.mutable_case_() = stored.job.case_();
  auto& described = *order.mutable_described_job();
  described = stored.job;
  described.clear_case_();
  described.clear_worker_pid();
  order.set_threads(1);
  order.set_checkpoint_interval_s(std::chrono::duration<double>(parts_.checkpoint_interval).count());
  // The daemon's limit may have changed since the job was accepted.
  const double own = stored.job.time_limit_s();
  const bool daemons = parts_.longest_job_s > 0.0 && (own == 0.0 || own > parts_.longest_job_s);
  order.set_time_limit_s(daemons ? parts_.longest_job_s : own);
  order.set_limit_is_daemons(daemons);
  order.set_epoch(parts_.journal.epoch().id);
  return order;
}

// On a cluster, a job also waits for a node, which may be another machine.
double JobRunner::predict(const store::StoredJob& stored, int threads) {
  if (stored.samples > 0 || stored.job.state() != v1::Job::PENDING || parts_.executor.keeps_workers()) return 0.0;
  const auto queued = parts_.reader.queued_job(stored.number, v1::Job::PENDING);
  return queued ? predicted_seconds(*queued, {threads}, threads, parts_.step_cost) : 0.0;
}

WorkerExit JobRunner::run_worker(const store::StoredJob& stored, Run& run) {
  parts_.folder.make_job_folder(stored.number);
  if (stored.samples > 0 && !parts_.folder.has_reports(stored.number)) throw BeginAgain{kReportsAreGone};
  worker::Order order = order_of(stored);
  order.set_threads(run.threads);
  order.set_memory_factor(losses_.memory_factor(stored.number));
  order.set_most_memory_bytes(parts_.most_memory_bytes);
  run.predicted_seconds = predict(stored, run.threads);
  const auto begin = std::chrono::steady_clock::now();
  auto out = parts_.executor.run(parts_.folder.job_folder(stored.number), order, events_of(stored), run.interruptions);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (out.final && out.final->device_use() != worker::Final::NO_DEVICE && is_last_word(out))
    parts_.metrics.count_device_run(out.final->device_use() == worker::Final::ADVANCED);
  return out;
}

WorkerEvents JobRunner::events_of(const store::StoredJob& stored) {
  const std::int64_t job = stored.number;
  WorkerEvents events;
  events.started = [this, job](int pid) {
    const auto now = parts_.reader.find_job(job);
    if (!now) throw Withdrawn();
    // An earlier daemon started the worker.
    if (now->job.state() == v1::Job::CANCELLING || now->job.state() == v1::Job::RUNNING) return parts_.hold.succeeded();
    store::StateChange running;
    running.state = v1::Job::RUNNING;
    running.worker_pid = pid;
    try {
      parts_.journal.change_state(job, running);
    } catch (const ServiceError& error) {
      const bool gone = error.kind() == ServiceError::Kind::not_found;
      if (gone || error.kind() == ServiceError::Kind::failed_precondition) throw Withdrawn();
      throw;
    }
    parts_.hold.succeeded();
    spdlog::info("{} runs in process {}", store::name_of(job), pid);
  };
  const auto channel = parts_.hub.open(job);
  events.placed = [this, channel](const std::string& place) {
    channel->set_place(place);
    // An executor that has accepted a job lacks nothing, though it may start the job much later.
    if (!place.empty()) parts_.hold.succeeded();
  };
  events.watched = [channel] { return channel->is_watched(); };
  events.reported = [this, job, channel, seen = Seen{-1, 0, stored.samples}](worker::Report& report) mutable {
    pass_on(job, seen, *channel, report);
  };
  return events;
}

// Samples reported again have the same bits.
void JobRunner::pass_on(std::int64_t job, Seen& seen, watch::Channel& channel, worker::Report& report) {
  switch (report.report_case()) {
    case worker::Report::kBegun:
      if (const auto& epoch = parts_.journal.epoch(); !epoch.admits(report.begun().epoch()))
        throw BeginAgain{"Restarted from step 0: the reports of its earlier workers are" + epoch.of_before() + "."};
      log_begin(store::name_of(job), report.begun());
      break;
    case worker::Report::kMesh:
      parts_.journal.set_mesh(job, report.mesh());
      channel.publish(std::move(*report.mutable_mesh()));
      break;
    case worker::Report::kSample:
      if (report.sample().step() <= seen.last_step) break;
      seen.last_step = report.sample().step();
      if (++seen.count <= seen.announced) break;
      parts_.journal.note_samples(job, seen.count,
                                  channel.is_watched() ? store::Journal::kSoon : store::Journal::kLazyCommit);
      break;
    case worker::Report::kFrame: channel.publish(std::move(*report.mutable_frame())); break;
    case worker::Report::kProgress:
      parts_.metrics.set_speed(job, report.progress().stalled() ? 0.0 : report.progress().steps_per_second());
      channel.publish(report.progress());
      break;
    case worker::Report::kFinal:
    case worker::Report::kStopping:
    case worker::Report::REPORT_NOT_SET: break;
  }
}

store::StateChange JobRunner::after(const store::StoredJob& stored, const WorkerExit& exit, Run& run) {
  if (exit.final && exit.final->has_begin_again()) throw BeginAgain{exit.final->begin_again()};
  if (exit.kind == WorkerExit::Kind::left) return {};
  if (exit.kind == WorkerExit::Kind::withdrawn) {
    // Cancelled in the cluster, it ends as if CancelJob had come. No effect if it has not started.
    store::StateChange cancelling;
    cancelling.state = v1::Job::CANCELLING;
    try_change(parts_.journal, stored.number, cancelling);
  }
  if (!exit.final && !is_lost(exit) && !has_started(stored.number)) return before_start(exit);
  auto next = outcome_of(exit);
  const bool is_cancelled = exit.kind == WorkerExit::Kind::cancelled || exit.kind == WorkerExit::Kind::withdrawn;
  if (is_cancelled && !is_last_word(exit)) {
    auto ended = given_up(stored, std::move(next), run);
    if (ended.state == v1::Job::CANCELLED && !exit.detail.empty()) ended.message = exit.detail;
    return ended;
  }
  if (!is_lost(exit)) return next;
  run.trouble = trouble_of_exit(exit);
  // A worker of an earlier daemon cannot report this through its exit code.
  if (!run.trouble && parts_.folder.is_full()) run.trouble = {Shortage::full_disk, "The data folder's disk is full."};
  if (run.trouble) return {};
  if (!got_further(stored.number)) return given_up(stored, std::move(next), run);
  spdlog::warn("{}: {}", store::name_of(stored.number), next.message);
  // Where the machine is short for other reasons, a higher limit would help nobody.
  if (next.cause == v1::Job::OUT_OF_MEMORY && (exit.at_own_limit || (exit.final && needs_more_memory(*exit.final)))) {
    losses_.raise_memory(stored.number);
    next.message += " The next attempt is allowed more.";
  }
  return tried_again(std::move(next));
}

// Whether a worker of the job has run since it was last PENDING.
bool JobRunner::has_started(std::int64_t job) {
  const auto now = parts_.reader.find_job(job);
  return now && (now->job.state() == v1::Job::RUNNING || now->job.state() == v1::Job::CANCELLING);
}

// The outcome for a job that left its executor before a worker ran.
store::StateChange JobRunner::before_start(const WorkerExit& exit) {
  if (exit.kind == WorkerExit::Kind::cancelled) throw Withdrawn();
  store::StateChange out;
  if (exit.kind == WorkerExit::Kind::suspended) out.state = v1::Job::SUSPENDED;
  if (exit.kind == WorkerExit::Kind::withdrawn) return outcome_of(exit);
  return out;
}

// Whether the job may be retried after a loss.
bool JobRunner::got_further(std::int64_t job) {
  try {
    parts_.journal.commit_samples();
  } catch (const std::exception&) {
    // The samples stored before count. The journal retries on its own and logs the failure.
  }
  const auto stored = parts_.reader.find_job(job);
  return losses_.may_retry(job, stored ? stored->samples : 0);
}

// Makes a result from the reports of lost workers, if possible.
store::StateChange JobRunner::given_up(const store::StoredJob& stored, store::StateChange loss, Run& run) {
  const bool is_cancelled = loss.state == v1::Job::CANCELLED;
  // The next daemon ends it.
  if (is_cancelled && run.daemons_end.stop_requested()) return {};
  // A cancelled job ends even if it was to be suspended or the disk is nearly full.
  const Interruptions interruptions =
      is_cancelled ? Interruptions{run.daemons_end, {}, run.interruptions.cancel} : run.interruptions;
  worker::Order order = order_of(stored);
  auto& end = *order.mutable_given_up();
  end.set_cancelled(is_cancelled);
  if (!is_cancelled) {
    end.set_cause(loss.cause);
    end.set_message(loss.message);
    end.set_remedy(loss.remedy);
  }
  try {
    parts_.folder.make_job_folder(stored.number);
    const auto exit =
        parts_.executor.run(parts_.folder.job_folder(stored.number), order, events_of(stored), interruptions);
    const bool has_result = is_last_word(exit) && exit.final->has_summary();
    const bool was_left = exit.kind == WorkerExit::Kind::stopped || exit.kind == WorkerExit::Kind::suspended;
    if (was_left && !is_last_word(exit) && is_cancelled) return {};
    if (has_result || (was_left && !is_last_word(exit))) return outcome_of(exit);
    if (!is_cancelled) run.trouble = trouble_of_exit(exit);
  } catch (const std::exception& error) {
    // A cancelled job ends without a result if none can be made now.
    if (!is_cancelled) run.trouble = trouble_of(error);
    spdlog::warn("{} could not write a result: {}", store::name_of(stored.number), error.what());
  }
  return loss;
}

v1::Job::State JobRunner::begin_again(std::int64_t job, const std::string& why) {
  end_leftover(job);
  try {
    parts_.journal.begin_again(job, why);
  } catch (const ServiceError& error) {
    if (error.kind() == ServiceError::Kind::not_found) return v1::Job::JOB_STATE_UNSPECIFIED;
    if (error.kind() != ServiceError::Kind::failed_precondition) throw;
    // A cancelled job ends without a result, and keeps its history.
    parts_.folder.clean_job_folder(job);
    return v1::Job::CANCELLING;
  }
  spdlog::warn("{}: {}", store::name_of(job), why);
  parts_.folder.discard_run(job);
  if (const auto channel = parts_.hub.find(job)) channel->forget();
  losses_.forget(job);
  return v1::Job::PENDING;
}

}  // namespace cellcrush::jobs
